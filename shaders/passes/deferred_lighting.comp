// Compute entry of lib/lighting/deferred_lighting.glsl: a pixel an invocation.
#include "lib/lighting/deferred_lighting.glsl"

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
