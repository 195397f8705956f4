// Takes what a scene's own GLSL changes of a surface.
#pragma once
#include "lib/material/hook_interface.glsl"
#include "lib/material/material_values.glsl"
#include "lib/surface/surface.glsl"

#if HOOKED && VIEW != VIEW_MOVED_TOO_FAR
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
