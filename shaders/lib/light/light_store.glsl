// Where the texels of lights are read from: buffer textures. A file included before may bring lightTexel() and
// lightShapeTexel() of its own, and say so by HAS_OTHER_LIGHT_STORE.
#pragma once
#include "shared/slots.h"
#include "shared/light.h"

#ifndef HAS_OTHER_LIGHT_STORE
layout(binding = TEXTURE_UNIT_LIGHTS) uniform samplerBuffer lightTexels;

// A texel of a light, in the order of LightTexels.
vec4 lightTexel(int index, int texel)
{
    return texelFetch(lightTexels, index * LIGHT_TEXELS + texel);
}

#if HAS_LIGHT_SHAPES
layout(binding = TEXTURE_UNIT_LIGHT_SHAPES) uniform samplerBuffer lightShapeTexels;

// The same in the order of LightShapeTexels.
vec4 lightShapeTexel(int index, int texel)
{
    return texelFetch(lightShapeTexels, index * LIGHT_SHAPE_TEXELS + texel);
}
#endif
#endif
