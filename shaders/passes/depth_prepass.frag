// Depth alone; only alpha-masked materials have anything to decide. With SHADING_DEPTH also the depth at which each
// sample will be lit, which with several samples a pixel is not the sample's own.
#include "lib/shading_depth.glsl"
#if HAS_ALPHA_MASK
#include "lib/rasterised.glsl"
#include "lib/coverage.glsl"
#endif

#if SHADING_DEPTH
layout(location = 0) out float depthOfShading;
#endif

void main()
{
#if SHADING_DEPTH
    depthOfShading = shadingDepth();
#endif
#if HAS_ALPHA_MASK
    if (coversNothing(materialBaseColor(rasterisedFragment()))) discard;
#endif
}
