// Where the texels of lights are read from. Every pass of a frame reads a buffer texture; the other stores are what the
// measured floor compares it with (validation/FloorLighting.h).
#pragma once
#include "shared/slots.h"
#include "shared/light.h"

#ifndef LIGHT_STORE
#define LIGHT_STORE LIGHT_STORE_TEXEL
#endif

#if LIGHT_STORE == LIGHT_STORE_UNIFORM
layout(std140, binding = UNIFORM_LIGHTS) uniform LightBlock
{
    vec4 lightTexels[LIGHT_UNIFORM_LIGHTS * LIGHT_TEXELS];
};
#elif LIGHT_STORE == LIGHT_STORE_STORAGE
layout(std430, binding = STORAGE_LIGHTS) readonly buffer LightBlock
{
    vec4 lightTexels[];
};
#else
layout(binding = TEXTURE_UNIT_LIGHTS) uniform samplerBuffer lightTexels;
#endif

// Texel 0 to 3 of a light, in the order of LightTexels.
vec4 lightTexel(int index, int texel)
{
#if LIGHT_STORE == LIGHT_STORE_TEXEL
    return texelFetch(lightTexels, index * LIGHT_TEXELS + texel);
#else
    return lightTexels[index * LIGHT_TEXELS + texel];
#endif
}
