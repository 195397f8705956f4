// Lights a covered pixel once from the G-buffer.
#pragma once
#include "shared/slots.h"
#include "lib/gbuffer/gbuffer.glsl"
#include "lib/lighting/views.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;

// Reverse-Z; 0 where nothing was drawn.
float depthOfPixel(ivec2 pixel)
{
    return texelFetch(depthChannel, pixel, 0).r;
}

vec4 deferredRadiance(ivec2 pixel, float depth)
{
    vec2 center = vec2(pixel) + 0.5;
    Surface surface = surfaceFromGBuffer(pixel);
    Viewpoint viewpoint = viewpointFromDepth(center, depth);
    precise vec3 viewed = viewedRadiance(surface, viewpoint, center);
    return vec4(viewed, 1.0);
}
