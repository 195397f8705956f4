// Shades surfaces as they are rasterised.
#include "lib/raster/rasterised.glsl"
#include "lib/raster/diffused_light.glsl"
#include "lib/raster/filmed.glsl"
#include "lib/raster/coverage.glsl"
#include "lib/raster/shading_place.glsl"
#include "lib/lighting/views.glsl"

#if HAS_PASSING_LIGHT
#include "lib/lighting/transmission.glsl"

layout(location = 0, index = 0) out vec4 radiance;
layout(location = 0, index = 1) out vec4 kept; // kept fraction of the background, by channel; for transmission
#else
layout(location = 0) out vec4 radiance;
#endif

void main()
{
    Fragment fragment = rasterisedFragment();
    vec4 baseColor = materialBaseColor(fragment);
    Surface surface = surfaceFromMaterial(fragment, baseColor);
    takeDiffusedLight(fragment, surface);
    coverWithFilm(fragment, surface);
    ShadingPlace place = shadingPlace();
    if (coversNothing(baseColor)) discard;
    Viewpoint viewpoint = viewpointFromDepth(place.pixel, place.depth);
    precise vec3 viewed = viewedRadiance(surface, viewpoint, gl_FragCoord.xy);
#if HAS_PASSING_LIGHT
    float coverage = material.transmission.y > 0.0 ? clamp(baseColor.a, 0.0, 1.0) : 1.0;
    radiance = vec4(viewed, coverage);
    kept = vec4(0.0);
#if VIEW == VIEW_FINAL
    if (material.transmission.x > 0.0) {
        // Uses the pixel's central ray, so that a surface without refraction shows this pixel's background.
        Viewpoint middle = viewpointFromDepth(gl_FragCoord.xy, place.depth);
        ThroughSurface through = lightThrough(surface, middle, gl_FragCoord.xy);
        precise vec3 shown = coverage * (viewed + through.radiance);
        precise vec3 behind = coverage * through.kept + (1.0 - coverage);
        radiance.rgb = shown;
        kept.rgb = behind;
    }
#endif
#elif BLENDED
    radiance = vec4(viewed, clamp(baseColor.a, 0.0, 1.0));
#else
    radiance = vec4(viewed, 1.0);
#endif
}
