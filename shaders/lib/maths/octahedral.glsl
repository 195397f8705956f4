// Unit vectors on the octahedral square -1..1. Source: Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors".
#pragma once
#include "shared/normals.h"

float signNotZero(float x) { return x >= 0.0 ? 1.0 : -1.0; }

vec2 encodeOctahedral(vec3 n)
{
    precise vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    precise vec2 code = n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * vec2(signNotZero(p.x), signNotZero(p.y));
    return code;
}

vec3 decodeOctahedral(vec2 p)
{
    vec3 n = directionOfOctahedral(p);
    precise vec3 unit = n / sqrt(dot(n, n));
    return unit;
}
