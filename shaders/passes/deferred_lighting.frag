// Lights every covered pixel once from the G-buffer; the others show the background.
#include "shared/slots.h"
#include "lib/gbuffer.glsl"
#include "lib/views.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;
layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depthChannel, pixel, 0).r;
    if (depth == 0.0) { // reverse-Z: nothing was drawn here
        radiance = frame.background;
        return;
    }
    Surface surface = surfaceFromGBuffer(pixel);
    Viewpoint viewpoint = viewpointFromDepth(gl_FragCoord.xy, depth);
    precise vec3 viewed = viewedRadiance(surface, viewpoint, gl_FragCoord.xy);
    radiance = vec4(viewed, 1.0);
}
