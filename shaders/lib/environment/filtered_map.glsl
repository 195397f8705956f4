// The map as it was filtered beforehand: all its levels in one picture, each the square of an unfolded octahedron with a
// border, so that the sampler interpolates across its edges. Level 0 of a texture alone is read: rasterisers that choose
// a level for four pixels at a time would show other levels where surfaces are drawn than where they are stored.
#pragma once
#include "lib/environment/environment_constants.glsl"
#include "lib/maths/octahedral.glsl"

layout(binding = TEXTURE_UNIT_ENVIRONMENT_FILTERED) uniform sampler2D filteredEnvironment;

vec3 filteredTexel(vec2 code, int side, int level)
{
    vec2 origin = vec2(0.0, float(filteredTop(int(environment.light.w), level)));
    precise vec2 place = (0.5 * code + 0.5) * float(side) + (origin + 1.0);
    precise vec2 uv = place / vec2(textureSize(filteredEnvironment, 0));
    return textureLod(filteredEnvironment, uv, 0.0).rgb;
}

vec3 filteredLevel(vec2 code, int level)
{
    return filteredTexel(code, filteredSide(int(environment.light.w), level), level);
}
