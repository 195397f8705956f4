#pragma once
// Decoding of stored normals for C++ and GLSL. The results are directions of any length; shading code normalises them.
#include "interop.h"

// Steps of a component relative to the largest one; fp32 holds each exactly.
#define NORMAL_SHARE_BITS 25
#define NORMAL_AXIS_BITS 3
#define NORMAL_SHARE_STEPS 16777215.0f
#define NORMAL_NO_SHARE 16777216

SHARED_BEGIN

// Direction of a NormalCode (lib/maths/normal_code.glsl); its largest component is +-NORMAL_SHARE_STEPS.
SHARED_FUNCTION vec3 directionOfShares(uvec2 shares, uint axis) {
    float first = float(int(shares.x) - NORMAL_NO_SHARE);
    float second = float(int(shares.y) - NORMAL_NO_SHARE);
    float along = (axis & 4u) != 0u ? -NORMAL_SHARE_STEPS : NORMAL_SHARE_STEPS;
    uint largest = axis & 3u;
    return vec3(largest == 0u ? along : first,
                largest == 2u   ? second
                : largest == 0u ? first
                                : along,
                largest == 2u ? along : second);
}

// Point on the octahedron for a point of the octahedral square -1..1. Source: Cigolle et al. 2014, "A Survey of
// Efficient Representations for Independent Unit Vectors".
SHARED_FUNCTION vec3 directionOfOctahedral(vec2 p) {
    SHARED_PRECISE float z = 1.0f - abs(p.x) - abs(p.y);
    SHARED_PRECISE float x = z < 0.0f ? (p.x >= 0.0f ? 1.0f - abs(p.y) : abs(p.y) - 1.0f) : p.x;
    SHARED_PRECISE float y = z < 0.0f ? (p.y >= 0.0f ? 1.0f - abs(p.x) : abs(p.x) - 1.0f) : p.y;
    return vec3(x, y, z);
}

// Decodes `width` bits to -1..1 in equal steps; 0 and both ends are exact.
SHARED_FUNCTION float decodeSigned(uint code, int width) {
    int middle = int((1u << width) - 1u) / 2;
    SHARED_PRECISE float x = float(int(code) - middle) / float(middle);
    return x;
}

SHARED_END
