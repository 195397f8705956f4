// Depth only; only alpha-masked materials discard. With SHADING_DEPTH also writes the depth at which each sample is
// shaded, which differs from the sample's depth with several samples per pixel, and its negative, so that the maxima of
// both over a pixel are the range.
#include "lib/raster/shading_place.glsl"
#if HAS_ALPHA_MASK
#include "lib/raster/rasterised.glsl"
#include "lib/raster/coverage.glsl"
#endif

#if SHADING_DEPTH
layout(location = 0) out vec2 depthOfShading;
#endif

void main()
{
#if SHADING_DEPTH
    float depth = shadingPlace().depth;
    depthOfShading = vec2(depth, -depth);
#endif
#if HAS_ALPHA_MASK
    if (coversNothing(materialBaseColor(rasterisedFragment()))) discard;
#endif
}
