// Places on a disk that stand for all of it: place i lies in ring i of so many of equal area, each a golden angle from
// the one before (Vogel 1979, "A better way to construct the sunflower head"); one random turn and one random share of
// the rings, the same for all places, make the mean over pixels exact.
#pragma once
#include "lib/maths/random.glsl"

// Two numbers of [0, 1), the same for a pixel and a light of the scene in every frame and technique.
vec2 shadowRandom(vec2 pixel, float sceneIndex)
{
    return unitOf(hashOf(uvec3(uvec2(pixel), uint(sceneIndex))).xy);
}

// A third one, for what is not flat.
float thirdShadowRandom(vec2 pixel, float sceneIndex)
{
    return unitOf(hashOf(uvec3(uvec2(pixel), uint(sceneIndex))).zz).x;
}

// Place i of SHADOW_SAMPLES on the unit disk.
vec2 diskPlace(int i, vec2 random)
{
    precise float angle = 6.2831853 * random.x + 2.3999632 * float(i);
    precise float radius = sqrt((float(i) + random.y) * (1.0 / float(SHADOW_SAMPLES)));
    return radius * vec2(cos(angle), sin(angle));
}
