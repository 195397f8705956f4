// Small numerical functions for all other library files.
#pragma once

const float kPi = 3.14159265358979323846;
const float kInversePi = 1.0 / kPi;

// Unit vector along v, or `fallback` if v has no direction (a zero-length normal texel, a singular node). Vectors
// outside about 1e-19 .. 1e19 would leave fp32's range when squared, so the length is computed after scaling.
vec3 safeNormalize(vec3 v, vec3 fallback)
{
    precise float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(largest > 0.0)) return fallback;
    precise vec3 scaled = v / largest;
    precise vec3 unit = scaled / sqrt(dot(scaled, scaled));
    return unit;
}

// Unit vector perpendicular to the unit vector n. Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
vec3 anyPerpendicular(vec3 n)
{
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    precise float a = -1.0 / (side + n.z);
    precise vec3 perpendicular = vec3(1.0 + side * (n.x * n.x) * a, side * (n.x * n.y) * a, -side * n.x);
    return perpendicular;
}
