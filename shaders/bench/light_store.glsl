// Light stores that the lower-bound benchmark (validation/lower_bound/LowerBoundLighting.h) compares with the
// renderer's. Include before lighting code. LIGHT_STORE_TEXEL keeps the renderer's.
#pragma once
#include "bench/lower_bound.h"
#include "shared/slots.h"
#include "shared/light.h"

#if LIGHT_STORE != LIGHT_STORE_TEXEL
#define HAS_OTHER_LIGHT_STORE

#if HAS_POLYGON_LIGHTS
#define SHAPE_TEXELS_A_LIGHT (LIGHT_SHAPE_TEXELS + LIGHT_CORNER_TEXELS)
#else
#define SHAPE_TEXELS_A_LIGHT LIGHT_SHAPE_TEXELS
#endif

#if LIGHT_STORE == LIGHT_STORE_UNIFORM
layout(std140, binding = UNIFORM_LIGHTS) uniform LightBlock
{
    vec4 lightTexels[LIGHT_UNIFORM_LIGHTS * LIGHT_TEXELS];
};
layout(std140, binding = UNIFORM_LIGHT_SHAPES) uniform LightShapeBlock
{
    vec4 lightShapeTexels[LIGHT_UNIFORM_LIGHTS * SHAPE_TEXELS_A_LIGHT];
};
#else
layout(std430, binding = STORAGE_LIGHTS) readonly buffer LightBlock
{
    vec4 lightTexels[];
};
layout(std430, binding = STORAGE_LIGHT_SHAPES) readonly buffer LightShapeBlock
{
    vec4 lightShapeTexels[];
};
#endif

// A texel of a light, in the order of LightTexels.
vec4 lightTexel(int index, int texel)
{
    return lightTexels[index * LIGHT_TEXELS + texel];
}

// A texel in the order of LightShapeTexels, followed by LightCornerTexels.
vec4 lightShapeTexel(int index, int texel)
{
    return lightShapeTexels[index * SHAPE_TEXELS_A_LIGHT + texel];
}
#endif
