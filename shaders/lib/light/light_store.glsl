// Reads the texels of lights from a buffer texture. A file included before may define other functions lightTexel() and
// lightShapeTexel(), together with HAS_OTHER_LIGHT_STORE.
#pragma once
#include "shared/slots.h"
#include "shared/light.h"

#ifndef HAS_OTHER_LIGHT_STORE
layout(binding = TEXTURE_UNIT_LIGHTS) uniform samplerBuffer lightTexels;

#if HAS_POLYGON_LIGHTS
#define TEXELS_BEFORE_SHADOW (LIGHT_TEXELS + LIGHT_SHAPE_TEXELS + LIGHT_CORNER_TEXELS)
#elif HAS_LIGHT_SHAPES
#define TEXELS_BEFORE_SHADOW (LIGHT_TEXELS + LIGHT_SHAPE_TEXELS)
#else
#define TEXELS_BEFORE_SHADOW LIGHT_TEXELS
#endif
#if HAS_LIGHT_SHADOW_TEXELS
#define TEXELS_A_LIGHT (TEXELS_BEFORE_SHADOW + LIGHT_SHADOW_TEXELS)
#else
#define TEXELS_A_LIGHT TEXELS_BEFORE_SHADOW
#endif

// A texel of a light, in the order of LightTexels.
vec4 lightTexel(int index, int texel)
{
    return texelFetch(lightTexels, index * TEXELS_A_LIGHT + texel);
}

#if HAS_LIGHT_SHAPES
// A texel in the order of LightShapeTexels, followed by LightCornerTexels.
vec4 lightShapeTexel(int index, int texel)
{
    return texelFetch(lightTexels, index * TEXELS_A_LIGHT + LIGHT_TEXELS + texel);
}
#endif

#if HAS_LIGHT_SHADOW_TEXELS
// LightShadowTexels::shadow.
vec4 lightShadowTexel(int index)
{
    return texelFetch(lightTexels, index * TEXELS_A_LIGHT + TEXELS_BEFORE_SHADOW);
}
#endif
#endif

#if HAS_POLYGON_LIGHTS
// A corner of a polygon, in coordinates along its axes.
vec2 lightCorner(int index, int number)
{
    vec4 two = lightShapeTexel(index, LIGHT_SHAPE_TEXELS + 1 + number / 2);
    return (number & 1) == 0 ? two.xy : two.zw;
}
#endif
