// Shades surfaces as they are rasterised.
#include "lib/raster/rasterised.glsl"
#include "lib/raster/diffused.glsl"
#include "lib/raster/coverage.glsl"
#include "lib/raster/shading_depth.glsl"
#include "lib/lighting/views.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    Fragment fragment = rasterisedFragment();
    vec4 baseColor = materialBaseColor(fragment);
    Surface surface = surfaceFromMaterial(fragment, baseColor);
    takeDiffusedLight(fragment, surface);
    float depth = shadingDepth();
    if (coversNothing(baseColor)) discard;
    Viewpoint viewpoint = viewpointFromDepth(gl_FragCoord.xy, depth);
    precise vec3 viewed = viewedRadiance(surface, viewpoint, gl_FragCoord.xy);
#if BLENDED
    radiance = vec4(viewed, clamp(baseColor.a, 0.0, 1.0));
#else
    radiance = vec4(viewed, 1.0);
#endif
}
