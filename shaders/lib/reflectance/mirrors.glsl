// Lobes that are mirrors in light from all around: GGX lobes of the least alpha, which roughness 0 becomes. They reflect
// the one direction that mirrors the viewer, by Fresnel's factor. Lights keep a lobe of that alpha, since a mirror shows no
// light without a surface.
#pragma once
#include "shared/environment.h"
#include "lib/reflectance/reflectance.glsl"

vec3 mirrorDirection(vec3 normal, vec3 toViewer)
{
    precise vec3 mirrored = 2.0 * dot(normal, toViewer) * normal - toViewer;
    return mirrored;
}

// How much of a lobe is a mirror: all of one of the least alpha, nothing from that of the first filtered level on.
float mirrorShare(float alpha)
{
    if (alpha <= ALPHA_MIN) return 1.0;
    precise float share = max((ENVIRONMENT_LEAST_ALPHA - alpha) / (ENVIRONMENT_LEAST_ALPHA - ALPHA_MIN), 0.0);
    return share;
}

#if HAS_MIRRORS
// Whether the surface's lobe is one.
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
// What it reflects of the radiance from there, before what the layers above leave of it.
vec3 mirrorReflectance(SeenSurface seen)
{
    if (HAS_METALLIC(seen.surface.model)) return fresnelSchlick(seen.f0, seen.fresnelRise, seen.nv);
    precise vec3 reflected = seen.surface.specular * fresnelDielectric(seen.surface.iorOrF90, seen.nv);
    return reflected;
}
#endif
#endif
