// The map as it was filtered beforehand: all its levels in one picture, each an octahedron with its faces divided into
// triangles, unfolded into a square. A texel is a corner of triangles, and between corners light is linear: the edges of
// the octahedron run along edges of triangles, where a bilinear sampler would interpolate across them and show them as
// lines.
#pragma once
#include "lib/environment/environment_constants.glsl"
#include "lib/maths/octahedral.glsl"

layout(binding = TEXTURE_UNIT_ENVIRONMENT_FILTERED) uniform sampler2D filteredEnvironment;

// `side` counts the cells along the square, which two triangles each fill.
vec3 filteredTexel(vec2 code, int side, int level)
{
    int halfSide = side / 2;
    ivec2 middle = ivec2(halfSide, halfSide + filteredTop(filteredHalvings(), level));
    // From the square's middle outwards all quarters are alike: a cell is halved by the edge that faces the middle.
    ivec2 outward = ivec2(signNotZero(code.x), signNotZero(code.y));
    precise vec2 place = abs(code) * float(halfSide);
    ivec2 cell = min(ivec2(place), ivec2(halfSide - 1));
    precise vec2 inside = place - vec2(cell);
    bool isInner = inside.x + inside.y <= 1.0;
    ivec2 corner = isInner ? cell : cell + 1;
    precise vec2 share = isInner ? inside : 1.0 - inside.yx;
    vec3 a = texelFetch(filteredEnvironment, middle + outward * corner, 0).rgb;
    vec3 b = texelFetch(filteredEnvironment, middle + outward * (cell + ivec2(1, 0)), 0).rgb;
    vec3 c = texelFetch(filteredEnvironment, middle + outward * (cell + ivec2(0, 1)), 0).rgb;
    precise vec3 light = a + share.x * (b - a) + share.y * (c - a);
    return light;
}

vec3 filteredLevel(vec2 code, int level)
{
    return filteredTexel(code, filteredSide(filteredHalvings(), level), level);
}
