// Lights a covered pixel once from the G-buffer; the others show the background.
#pragma once
#include "shared/slots.h"
#include "lib/gbuffer.glsl"
#include "lib/views.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;

vec4 deferredRadiance(ivec2 pixel)
{
    float depth = texelFetch(depthChannel, pixel, 0).r;
    if (depth == 0.0) return frame.background; // reverse-Z: nothing was drawn here
    vec2 center = vec2(pixel) + 0.5;
    Surface surface = surfaceFromGBuffer(pixel);
    Viewpoint viewpoint = viewpointFromDepth(center, depth);
    precise vec3 viewed = viewedRadiance(surface, viewpoint, center);
    return vec4(viewed, 1.0);
}
