// The stores of lights that the measured lower bound compares with the product's
// (validation/lower_bound/LowerBoundLighting.h). Include it before lighting code. LIGHT_STORE_TEXEL leaves the product's.
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

// The same in the order of LightShapeTexels and, behind them, LightCornerTexels.
vec4 lightShapeTexel(int index, int texel)
{
    return lightShapeTexels[index * SHAPE_TEXELS_A_LIGHT + texel];
}
#endif
