// Mirror lobes under environment light: GGX lobes of the minimum alpha, from roughness 0. They reflect only the
// direction that mirrors the viewer, by Fresnel's factor. Under lights they stay lobes of that alpha, since a mirror
// would not show a light without a surface.
#pragma once
#include "shared/environment.h"
#include "lib/reflectance/reflectance.glsl"

vec3 mirrorDirection(vec3 normal, vec3 toViewer)
{
    precise vec3 mirrored = 2.0 * dot(normal, toViewer) * normal - toViewer;
    return mirrored;
}

// Mirror weight of a lobe: 1 at the minimum alpha, 0 from that of the first filtered level on.
float mirrorShare(float alpha)
{
    if (alpha <= ALPHA_MIN) return 1.0;
    precise float share = max((ENVIRONMENT_LEAST_ALPHA - alpha) / (ENVIRONMENT_LEAST_ALPHA - ALPHA_MIN), 0.0);
    return share;
}

#if HAS_MIRRORS
// Whether the surface's lobe is a mirror.
bool isMirror(SeenSurface seen)
{
#if HAS_GGX_MODELS
    Surface surface = seen.surface;
    if (SPECULAR_OFF != 0 || !(seen.nv > 0.0) || surface.alpha > ALPHA_MIN) return false;
#if HAS_TANGENT_FRAME
    if (isAnisotropic(surface) && surface.alphaBitangent > ALPHA_MIN) return false;
#endif
    return IS_MICROFACET(surface.model) || HAS_METALLIC(surface.model);
#else
    return false;
#endif
}

#if HAS_GGX_MODELS
// Reflectance of a mirror lobe, without the layers above.
vec3 mirrorReflectance(SeenSurface seen)
{
    if (HAS_METALLIC(seen.surface.model)) return fresnelSchlick(seen.f0, seen.fresnelRise, seen.nv);
    precise vec3 reflected = seen.surface.specular * fresnelDielectric(seen.surface.iorOrF90, seen.nv);
    return reflected;
}
#endif
#endif
