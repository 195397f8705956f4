// Procedural surface of the lower-bound benchmark (validation/lower_bound/LowerBoundLighting.h), with the scene's
// models. It differs at every pixel, so that compilers cannot hoist work out of the light loop.
#pragma once
#include "lib/surface/camera.glsl"
#include "lib/maths/octahedral.glsl"
#include "lib/surface/surface.glsl"
#include "bench/lower_bound.h"

// 0 to 1; neighbouring pixels differ.
float boundFraction(vec2 pixel, vec2 steps)
{
    precise float share = fract(dot(pixel, steps));
    return share;
}

// Depth-buffer value between the two distances of bench/lower_bound.h.
float boundDepth(vec2 pixel)
{
    precise float viewDepth = BOUND_NEAREST_METRES
                              + (BOUND_FARTHEST_METRES - BOUND_NEAREST_METRES) * boundFraction(pixel, vec2(0.00371, 0.00533));
    precise float ahead = viewDepth - view.eyeLS.w;
    return depthFromAhead(ahead);
}

#if HAS_LIT_MODELS
// Alternates between the scene's lit models in blocks of 64 x 64 pixels, so that pixels shaded side by side share a
// model, as on most surfaces of a scene.
uint boundModel(vec2 pixel)
{
#ifdef SOLE_MODEL
    return SOLE_MODEL;
#else
    const uint models[] = uint[](LIT_MODELS);
    uvec2 block = uvec2(pixel) / 64u;
    return models[(block.x + block.y) % uint(models.length())];
#endif
}

// Sets the parameters of optional lobes and layers, on every surface if the scene's features include them.
void setBoundLobes(vec2 pixel, inout Surface surface)
{
    setNeutralLobes(surface);
    precise float parameter = 8.0 + 64.0 * boundFraction(pixel, vec2(0.0143, 0.0203));
    surface.parameter = parameter;
#if HAS_MASKING_OPTIONS
    surface.masking = HAS_TWO_ALPHAS(surface.model) ? MASKING_DIRECTIONAL : MASKING_HALF_VECTOR;
#endif
#if HAS_TANGENT_FRAME
    precise vec3 across = vec3(1.0, 0.0, 0.0) - surface.normalLS * surface.normalLS.x;
    precise vec3 tangent = across / sqrt(dot(across, across)); // the surface's normals lie around the z axis
    surface.tangentLS = tangent;
    precise float alphaBitangent = 0.1 + 0.8 * boundFraction(pixel, vec2(0.0247, 0.0073));
    surface.alphaBitangent = alphaBitangent;
#endif
#if HAS_CLEARCOAT
    precise float factor = 0.5 + 0.5 * boundFraction(pixel, vec2(0.0183, 0.0059));
    surface.coatNormalCode = encodeOctahedral(surface.normalLS);
    surface.coatFactor = HAS_LAYERS(surface.model) ? factor : 0.0;
    precise float coatAlpha = 0.05 + 0.4 * boundFraction(pixel, vec2(0.0067, 0.0287));
    surface.coatAlpha = coatAlpha;
#endif
#if HAS_SHEEN
    precise float color = 0.1 + 0.4 * boundFraction(pixel, vec2(0.0037, 0.0231));
    surface.sheenColor = HAS_LAYERS(surface.model) ? vec3(color) : vec3(0.0);
    precise float sheenAlpha = 0.1 + 0.6 * boundFraction(pixel, vec2(0.0197, 0.0083));
    surface.sheenAlpha = sheenAlpha;
#endif
}

Surface boundSurface(vec2 pixel, Viewpoint viewpoint)
{
    Surface surface;
    surface.model = boundModel(pixel);
    precise vec3 albedo = 0.2 + 0.6 * vec3(boundFraction(pixel, vec2(0.0127, 0.0311)), boundFraction(pixel, vec2(0.0213, 0.0171)),
                                           boundFraction(pixel, vec2(0.0299, 0.0087)));
    surface.albedo = albedo;
    surface.metallic = boundFraction(pixel, vec2(0.0153, 0.0191));
    precise float alpha = 0.1 + 0.8 * boundFraction(pixel, vec2(0.0097, 0.0273));
    surface.alpha = alpha;
    precise float iorOrF90 = 1.0;
    precise vec3 specular = defaultSpecular(surface.model);
    if (IS_MICROFACET(surface.model)) iorOrF90 = 1.6 - 0.1 * boundFraction(pixel, vec2(0.0181, 0.0221));
#if HAS_SPECULAR
    if (!IS_MICROFACET(surface.model)) iorOrF90 = 1.0 - 0.1 * boundFraction(pixel, vec2(0.0181, 0.0221));
    specular *= 0.5 + 0.5 * boundFraction(pixel, vec2(0.0061, 0.0149));
#endif
    surface.iorOrF90 = iorOrF90;
    surface.specular = specular;
    surface.emission = vec3(0.0);
    // Tilted by up to 12 degrees from the viewer, so that it faces the lights, which lie around the eye.
    precise vec3 tilted = viewpoint.toViewerLS + vec3(0.3 * boundFraction(pixel, vec2(0.0117, 0.0139)) - 0.15,
                                                      0.3 * boundFraction(pixel, vec2(0.0163, 0.0109)) - 0.15, 0.0);
    precise vec3 normal = tilted / sqrt(dot(tilted, tilted));
    surface.normalLS = normal;
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
    setBoundLobes(pixel, surface);
    return surface;
}
#endif
