// Applies a scene's hook to a surface.
#pragma once
#include "lib/material/hook_interface.glsl"
#include "lib/material/material_values.glsl"
#include "lib/maths/cut_loop.glsl"
#include "lib/surface/surface.glsl"

#if HOOKED && VIEW != VIEW_MOVED_TOO_FAR
const float HOOK_EMISSION_MOST = 1e30; // scenes::kMostEmission

// Clamps a hook's output to bounds that are widened to its input, so that an unchanged value keeps every bit. NaN
// becomes the minimum; GLSL's clamp() is undefined for NaN.
float boundHooked(float given, float found, float least, float most)
{
    float low = min(found, least), high = max(found, most);
    return given >= low ? min(given, high) : low;
}
vec3 boundHooked(vec3 given, vec3 found, float least, float most)
{
    return vec3(boundHooked(given.r, found.r, least, most), boundHooked(given.g, found.g, least, most),
                boundHooked(given.b, found.b, least, most));
}

void takeHook(Fragment fragment, inout Surface surface)
{
    if ((material.kind.y & MATERIAL_FLAG_HOOKED) == 0u) return;
    HookedSurface hooked = HookedSurface(surface.albedo, surface.emission, surface.alpha, surface.metallic);
    hookSurface(hooked, HookInputs(vec2(fragment.texCoord[0]), fragment.positionOS, fragment.instance));
    surface.albedo = boundHooked(hooked.color, surface.albedo, 0.0, 1.0);
    surface.emission = boundHooked(hooked.emission, surface.emission, 0.0, HOOK_EMISSION_MOST);
    if (hookIsCut(fragment.instance)) surface.emission = vec3(CUT_LOOP);
    if (IS_MICROFACET(surface.model) || HAS_METALLIC(surface.model))
        surface.alpha = boundHooked(hooked.alpha, max(surface.alpha, ALPHA_MIN), ALPHA_MIN, 1.0);
    if (HAS_METALLIC(surface.model)) surface.metallic = boundHooked(hooked.metallic, surface.metallic, 0.0, 1.0);
}
#else
#define takeHook(fragment, surface)
#endif
