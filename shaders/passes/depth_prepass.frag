// Depth alone; only alpha-masked materials have anything to decide. With SHADING_DEPTH also the depth at which each
// sample will be lit, which with several samples per pixel is not the sample's own depth, and the same negated, so that
// the largest of each over a pixel is its range.
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
