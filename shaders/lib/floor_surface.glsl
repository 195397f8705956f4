// The surface that the measured floor lights (validation/FloorLighting.h): made from the pixel's place alone, of the
// models that the scene uses, and different at every pixel, so that no compiler lifts anything out of the light loop.
#pragma once
#include "lib/camera.glsl"
#include "shared/floor.h"

// 0 to 1; neighbouring pixels differ.
float floorShare(vec2 pixel, vec2 steps)
{
    precise float share = fract(dot(pixel, steps));
    return share;
}

// Between the two distances of shared/floor.h.
float floorDepth(vec2 pixel)
{
    precise float viewDepth = FLOOR_NEAREST_METRES
                              + (FLOOR_FARTHEST_METRES - FLOOR_NEAREST_METRES) * floorShare(pixel, vec2(0.00371, 0.00533));
    vec4 lens = frame.depthToViewDepth;
    precise float depth = (lens.x - viewDepth * lens.z) / (viewDepth * lens.w - lens.y);
    return depth;
}

#if HAS_LIT_MODELS
// Where the scene uses several lit models they take turns in blocks of 64 pixels, so that the pixels that a processor
// shades side by side share one, as they do on most surfaces of a scene.
uint floorModel(vec2 pixel)
{
#ifdef SOLE_MODEL
    return SOLE_MODEL;
#else
    const uint models[] = uint[](
#if HAS_LAMBERT
        MODEL_LAMBERT,
#endif
#if HAS_MICROFACET
        MODEL_MICROFACET,
#endif
#if HAS_METALLIC_ROUGHNESS
        MODEL_METALLIC_ROUGHNESS,
#endif
        MODEL_SINGLE_COLOR);
    uvec2 block = uvec2(pixel) / 64u;
    return models[(block.x + block.y) % uint(models.length() - 1)]; // the last one is unlit and only ends the list
#endif
}

Surface floorSurface(vec2 pixel, Viewpoint viewpoint)
{
    Surface surface;
    surface.model = floorModel(pixel);
    precise vec3 albedo = 0.2 + 0.6 * vec3(floorShare(pixel, vec2(0.0127, 0.0311)), floorShare(pixel, vec2(0.0213, 0.0171)),
                                           floorShare(pixel, vec2(0.0299, 0.0087)));
    surface.albedo = albedo;
    surface.metallic = floorShare(pixel, vec2(0.0153, 0.0191));
    precise float alpha = 0.1 + 0.8 * floorShare(pixel, vec2(0.0097, 0.0273));
    surface.alpha = alpha;
    precise float iorOrF90 = 1.0;
    precise vec3 specular = defaultSpecular(surface.model);
#if HAS_MICROFACET
    if (surface.model == MODEL_MICROFACET) iorOrF90 = 1.6 - 0.1 * floorShare(pixel, vec2(0.0181, 0.0221));
#endif
#if HAS_SPECULAR
    if (surface.model != MODEL_MICROFACET) iorOrF90 = 1.0 - 0.1 * floorShare(pixel, vec2(0.0181, 0.0221));
    specular *= 0.5 + 0.5 * floorShare(pixel, vec2(0.0061, 0.0149));
#endif
    surface.iorOrF90 = iorOrF90;
    surface.specular = specular;
    surface.emission = vec3(0.0);
    // Tilted by up to 12 degrees from the viewer, so that it faces the lights, which lie around the eye.
    precise vec3 tilted = viewpoint.toViewerLS + vec3(0.3 * floorShare(pixel, vec2(0.0117, 0.0139)) - 0.15,
                                                      0.3 * floorShare(pixel, vec2(0.0163, 0.0109)) - 0.15, 0.0);
    precise vec3 normal = tilted / sqrt(dot(tilted, tilted));
    surface.normalLS = normal;
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
    return surface;
}
#endif
