// Prefiltered environment map: all levels in one image, each an octahedral map whose faces are divided into triangles.
// Texels are corners of triangles, and light is linear within a triangle. Edges of the octahedron coincide with edges
// of triangles, whereas a bilinear sampler would interpolate across them and make them visible as lines.
#pragma once
#include "lib/environment/environment_constants.glsl"
#include "lib/maths/octahedral.glsl"

layout(binding = TEXTURE_UNIT_ENVIRONMENT_FILTERED) uniform sampler2D filteredEnvironment;

// `side`: cells along the side of the square, of two triangles each.
vec3 filteredTexel(vec2 code, int side, int level)
{
    int halfSide = side / 2;
    ivec2 middle = ivec2(halfSide, halfSide + filteredTop(filteredHalvings(), level));
    // The quadrants around the square's centre are symmetric: a cell is halved by the diagonal that faces the centre.
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
