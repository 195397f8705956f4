// What a scene's own GLSL may change of a surface, and what it knows of it (docs/hooks.md). Its text stands behind this
// one, and so does the block `hook` with the time and its parameters.
#pragma once
#include "shared/hook.h"
#include "lib/material/material_values.glsl"
#include "lib/surface/surface.glsl"

#if HOOKED
struct HookedSurface {
    vec3 color;     // k_d, or base colour of metallic_roughness, linear
    vec3 emission;  // radiance that needs no light; all of an unlit surface
    float alpha;    // GGX alpha, of models that have one; along the tangent where the lobe is anisotropic
    float metallic; // of metallic_roughness
};

struct HookInputs {
    vec2 uv;         // the first texture coordinates, 0 where the mesh has none
    vec3 positionOS; // as drawn: after skins and morph targets
    int instance;    // place of the mesh instance in the scene, from 0
};

// The scene's.
void hookSurface(inout HookedSurface surface, HookInputs inputs);

const float HOOK_EMISSION_MOST = 1e30; // scenes::kMostEmission

// Values that a hook leaves alone keep every bit: no bound is within them.
void takeHook(Fragment fragment, inout Surface surface)
{
    if ((material.kind.y & MATERIAL_FLAG_HOOKED) == 0u) return;
    HookedSurface hooked = HookedSurface(surface.albedo, surface.emission, surface.alpha, surface.metallic);
    hookSurface(hooked, HookInputs(vec2(fragment.texCoord[0]), fragment.positionOS, fragment.instance));
    surface.albedo = clamp(hooked.color, min(surface.albedo, vec3(0.0)), max(surface.albedo, vec3(1.0)));
    surface.emission = clamp(hooked.emission, min(surface.emission, vec3(0.0)),
                             max(surface.emission, vec3(HOOK_EMISSION_MOST)));
    if (IS_MICROFACET(surface.model) || HAS_METALLIC(surface.model))
        surface.alpha = clamp(hooked.alpha, ALPHA_MIN, max(surface.alpha, 1.0));
    if (HAS_METALLIC(surface.model))
        surface.metallic = clamp(hooked.metallic, min(surface.metallic, 0.0), max(surface.metallic, 1.0));
}
#else
#define takeHook(fragment, surface)
#endif
