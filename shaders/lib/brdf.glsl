// The microfacet terms, each in the form that keeps its digits in fp32 (stated and bounded in docs/numerics.md).
// Everything is `precise`, so that no compiler contracts one technique's copy differently from another's.
#pragma once
#include "lib/math.glsl"

// GGX distribution of normals. Source: Walter 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33,
// rewritten as alpha^2 / (pi t^2) with t = alpha^2 (n.h)^2 + |n x h|^2: 1 - (n.h)^2 would cancel near the peak.
float distributionGgx(float alpha, vec3 n, vec3 h)
{
    precise float cosine = dot(n, h);
    if (!(cosine > 0.0)) return 0.0;
    precise vec3 across = cross(n, h);
    precise float alpha2 = alpha * alpha;
    precise float t = alpha2 * (cosine * cosine) + dot(across, across);
    precise float d = alpha2 / (kPi * (t * t));
    return d;
}

// sqrt(alpha^2 + (1 - alpha^2) c^2), the length that Smith's masking compares with the cosine c.
float smithLength(float alpha, float cosine)
{
    precise float alpha2 = alpha * alpha;
    precise float q = sqrt(alpha2 + (1.0 - alpha2) * (cosine * cosine));
    return q;
}

// G / (4 n.l n.v) for separable Smith masking, G = G1(l) G1(v). Source: Walter 2007, eq. 23 and 34; the cosines of G1's
// numerator cancel against the denominator, so grazing directions divide by nothing small. Needs both cosines > 0.
float visibilitySeparable(float alpha, float cosineLight, float cosineView)
{
    precise float v = 1.0 / ((cosineLight + smithLength(alpha, cosineLight)) * (cosineView + smithLength(alpha, cosineView)));
    return v;
}

// The same for height-correlated Smith masking. Source: Heitz 2014, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", eq. 99. Needs both cosines > 0.
float visibilityCorrelated(float alpha, float cosineLight, float cosineView)
{
    precise float v = 0.5 / (cosineLight * smithLength(alpha, cosineView) + cosineView * smithLength(alpha, cosineLight));
    return v;
}

// Fresnel reflectance of a smooth dielectric for unpolarised light; ior is n2/n1, cosine the one between light and half
// vector. Source: Cook and Torrance 1982; g - c is taken as (ior - 1)(ior + 1) / (g + c), which keeps its digits near ior = 1.
float fresnelDielectric(float ior, float cosine)
{
    precise float c = abs(cosine);
    precise float contrast = (ior - 1.0) * (ior + 1.0);
    if (contrast == 0.0) return 0.0;
    precise float g2 = contrast + c * c;
    if (g2 < 0.0) return 1.0; // total internal reflection
    precise float sum = sqrt(g2) + c;
    precise float difference = contrast / sum;
    precise float a = difference / sum;
    precise float b = (c * sum - 1.0) / (c * difference + 1.0);
    precise float f = 0.5 * (a * a) * (1.0 + b * b);
    return f;
}

// Schlick's approximation between f0 and f90. Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
vec3 fresnelSchlick(vec3 f0, float f90, float cosine)
{
    precise float m = clamp(1.0 - cosine, 0.0, 1.0);
    precise float m2 = m * m;
    precise float m5 = m2 * m2 * m;
    precise vec3 f = f0 + (vec3(f90) - f0) * m5;
    return f;
}
