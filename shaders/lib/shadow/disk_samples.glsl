// Stratified samples of a disk: sample i lies in ring i of SHADOW_SAMPLES rings of equal area, each a golden angle from
// the one before (Vogel 1979, "A better way to construct the sunflower head"); one random rotation and one random
// offset within the rings, the same for all samples, make the mean over pixels exact.
#pragma once
#include "lib/maths/random.glsl"

// Two random numbers in [0, 1), the same for a pixel and a light of the scene in every frame and technique.
vec2 shadowRandom(vec2 pixel, float sceneIndex)
{
    return unitOf(hashOf(uvec3(uvec2(pixel), uint(sceneIndex))).xy);
}

// A third random number, for lights that are not flat.
float thirdShadowRandom(vec2 pixel, float sceneIndex)
{
    return unitOf(hashOf(uvec3(uvec2(pixel), uint(sceneIndex))).zz).x;
}

// Sample i of SHADOW_SAMPLES on the unit disk.
vec2 diskPlace(int i, vec2 random)
{
    precise float angle = 6.2831853 * random.x + 2.3999632 * float(i);
    precise float radius = sqrt((float(i) + random.y) * (1.0 / float(SHADOW_SAMPLES)));
    return radius * vec2(cos(angle), sin(angle));
}
