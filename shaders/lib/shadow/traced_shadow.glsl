// Shadows by rays from a point to the light, or to a few places on its disk.
#pragma once
#include "lib/light/light_store.glsl"
#include "lib/shadow/caster_walk.glsl"

#if HAS_SOFT_SHADOWS
// Two numbers of [0, 1), the same for a pixel and a light of the scene in every frame and technique. Source: pcg3d of
// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
vec2 shadowRandom(vec2 pixel, float sceneIndex)
{
    uvec3 v = uvec3(uvec2(pixel), uint(sceneIndex)) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    return vec2(v.xy >> 8) * (1.0 / 16777216.0);
}
#endif

// What casters let through of light `index`: one in a place, or (isFar) one from far away in that direction, to which
// rays end behind all casters. In world axes, whose numbers do not depend on those of lighting space.
float tracedShadow(int index, vec3 placeLS, bool isFar, Viewpoint viewpoint)
{
    precise vec3 fromPoint = isFar ? placeLS : placeLS - viewpoint.positionLS;
    precise vec3 toLight = mat3(view.worldFromLS) * fromPoint;
    // In units of CS all casters lie within 1 of its origin.
    precise float farAway = 2.0 * (1.0 + length(positionCS(viewpoint.positionLS)));
    float reach = isFar ? farAway : casterTree.rwsOriginCS.w;
    float lightRounding = isFar ? 0.0 : roundingAt(placeLS);
#if HAS_SOFT_SHADOWS
    // A light without a size takes one ray. Else ray i goes to ring i of SHADOW_SAMPLES of equal area, each a golden
    // angle from the one before (Vogel 1979, "A better way to construct the sunflower head"); one random turn and one
    // random share of the rings, the same for all, make the mean over pixels exact.
    vec4 size = lightSizeTexel(index);
    int rays = size.x > 0.0 ? SHADOW_SAMPLES : 1;
    precise float perRay = 1.0 / float(rays);
    precise vec3 ahead = toLight * (1.0 / sqrt(max(dot(toLight, toLight), 1e-37)));
    precise vec3 aside = abs(ahead.x) < 0.6 ? vec3(0.0, ahead.z, -ahead.y) : vec3(-ahead.z, 0.0, ahead.x);
    precise vec3 across = aside * (size.x / max(length(aside), 1e-18));
    precise vec3 up = cross(ahead, across);
    vec2 random = shadowRandom(viewpoint.pixel, size.y);
    precise float seen = 0.0;
    int i = 0;
    for (; i < rays; ++i) {
        precise float angle = 6.2831853 * random.x + 2.3999632 * float(i);
        precise float radius = sqrt((float(i) + random.y) * perRay);
        precise vec3 toDisk = toLight + (radius * cos(angle)) * across + (radius * sin(angle)) * up;
        seen += visibilityAlong(shadowRay(viewpoint.positionLS, reach * toDisk, lightRounding));
    }
    if (i < rays) return uintBitsToFloat(0x7FC00000u); // a loop that was ended, as in visibilityAlong()
    return seen * perRay;
#else
    return visibilityAlong(shadowRay(viewpoint.positionLS, reach * toLight, lightRounding));
#endif
}
