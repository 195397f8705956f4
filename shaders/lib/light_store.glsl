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
#if HAS_LIGHT_SHAPES
layout(std140, binding = UNIFORM_LIGHT_SHAPES) uniform LightShapeBlock
{
    vec4 lightShapeTexels[LIGHT_UNIFORM_LIGHTS * LIGHT_SHAPE_TEXELS];
};
#endif
#elif LIGHT_STORE == LIGHT_STORE_STORAGE
layout(std430, binding = STORAGE_LIGHTS) readonly buffer LightBlock
{
    vec4 lightTexels[];
};
#if HAS_LIGHT_SHAPES
layout(std430, binding = STORAGE_LIGHT_SHAPES) readonly buffer LightShapeBlock
{
    vec4 lightShapeTexels[];
};
#endif
#else
layout(binding = TEXTURE_UNIT_LIGHTS) uniform samplerBuffer lightTexels;
#if HAS_LIGHT_SHAPES
layout(binding = TEXTURE_UNIT_LIGHT_SHAPES) uniform samplerBuffer lightShapeTexels;
#endif
#endif

#if LIGHT_STORE == LIGHT_STORE_TEXEL
#define LIGHT_FETCH(texels, at) texelFetch(texels, at)
#else
#define LIGHT_FETCH(texels, at) texels[at]
#endif

// A texel of a light, in the order of LightTexels.
vec4 lightTexel(int index, int texel)
{
    return LIGHT_FETCH(lightTexels, index * LIGHT_TEXELS + texel);
}

#if HAS_LIGHT_SHAPES
// The same in the order of LightShapeTexels.
vec4 lightShapeTexel(int index, int texel)
{
    return LIGHT_FETCH(lightShapeTexels, index * LIGHT_SHAPE_TEXELS + texel);
}
#endif
