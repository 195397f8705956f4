// Fragment entry of lib/lighting/deferred_lighting.glsl.
#include "lib/lighting/deferred_lighting.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depthOfPixel(pixel);
    // The background stays as it was cleared: software rasterisers leave a block early when all its pixels are discarded.
    if (depth == 0.0) discard;
    radiance = deferredRadiance(pixel, depth);
}
