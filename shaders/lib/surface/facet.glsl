// The normal of the triangle that a surface lies on, unlike the one that it is lit with; it points away from the viewer.
// Shadows need it (lib/shadow/own_triangle.glsl). Stored in 24 bits; all techniques light with the stored one.
#pragma once
#include "shared/facet.h"
#include "lib/maths/octahedral.glsl"

uint encodeFacet(vec3 normal)
{
    vec2 code = encodeOctahedral(normal);
    // As decodeSigned() reads it: the largest code stands for no place.
    precise vec2 share = clamp(0.5 * code + 0.5, 0.0, 1.0) * float((1 << FACET_BITS) - 2) + 0.5;
    uvec2 fields = uvec2(share);
    return fields.x | (fields.y << FACET_BITS);
}

vec3 decodeFacet(uint code)
{
    uint most = (1u << FACET_BITS) - 1u;
    return decodeOctahedral(vec2(decodeSigned(code & most, FACET_BITS), decodeSigned(code >> FACET_BITS, FACET_BITS)));
}
