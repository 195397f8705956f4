// Geometric normal of a surface's triangle, away from the viewer; shadows need it besides the shading normal
// (lib/shadow/own_triangle.glsl). Stored in 24 bits; all techniques use the decoded one.
#pragma once
#include "shared/facet.h"
#include "lib/maths/octahedral.glsl"

uint encodeFacet(vec3 normal)
{
    vec2 code = encodeOctahedral(normal);
    // Matches decodeSigned(), which leaves the largest code unused.
    precise vec2 share = clamp(0.5 * code + 0.5, 0.0, 1.0) * float((1 << FACET_BITS) - 2) + 0.5;
    uvec2 fields = uvec2(share);
    return fields.x | (fields.y << FACET_BITS);
}

vec3 decodeFacet(uint code)
{
    uint most = (1u << FACET_BITS) - 1u;
    return decodeOctahedral(vec2(decodeSigned(code & most, FACET_BITS), decodeSigned(code >> FACET_BITS, FACET_BITS)));
}
