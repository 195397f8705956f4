// Shades every covered pixel once from the G-buffer, as a fragment or compute shader (LIGHTING_IN_COMPUTE).
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

#if LIGHTING_IN_COMPUTE
layout(local_size_x = LIGHTING_GROUP_SIDE, local_size_y = LIGHTING_GROUP_SIDE) in;
layout(binding = IMAGE_UNIT_RADIANCE, rgba32f) writeonly uniform image2D radianceImage;

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view.sizePixels.xy))) return;
    float depth = depthOfPixel(ivec2(pixel));
    vec4 radiance = view.background;
    if (depth != 0.0) radiance = deferredRadiance(ivec2(pixel), depth);
    imageStore(radianceImage, ivec2(pixel), radiance);
}
#else
layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depthOfPixel(pixel);
    // Avoids discard, which makes software rasterisers read and mask the pixels of the target.
    radiance = view.background;
    if (depth != 0.0) radiance = deferredRadiance(pixel, depth);
}
#endif
