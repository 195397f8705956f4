// Reflectance of lobes under uniform illumination, from the table of renderer/frame/LobeTable.h.
#pragma once
#include "shared/lobe_table.h"
#include "lib/reflectance/mirrors.glsl"
#include "lib/reflectance/reflectance.glsl"
#if HAS_ANISOTROPY
#include "lib/reflectance/visible_facets.glsl"
#endif

layout(binding = TEXTURE_UNIT_LOBES) uniform sampler2DArray lobeTable;

// `place` from 0 to 1 along both sides.
vec4 lobeTexelAt(vec2 place, int layer)
{
    precise vec2 texel = (place * float(LOBE_TABLE_SIDE - 1) + 0.5) / float(LOBE_TABLE_SIDE);
    return textureLod(lobeTable, vec3(texel, float(layer)), 0.0);
}

vec4 lobeTexel(float cosine, float alpha, int layer)
{
    precise vec2 place = sqrt(clamp(vec2(cosine, alpha), 0.0, 1.0));
    return lobeTexelAt(place, layer);
}

// Alpha of an isotropic GGX lobe as wide as the surface's: the table has only one alpha.
float lobeAlpha(Surface surface)
{
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) {
        precise float alpha = min(sqrt(2.0 / (surface.parameter + 2.0)), 1.0);
        return alpha;
    }
#endif
#if HAS_TANGENT_FRAME
    if (isAnisotropic(surface)) {
        // The variance of microfacet slopes is proportional to alpha^2, so this is its mean over all azimuths.
        precise float mean2 = 0.5 * (surface.alpha * surface.alpha + surface.alphaBitangent * surface.alphaBitangent);
        precise float mean = sqrt(mean2);
        return mean;
    }
#endif
    return surface.alpha;
}

#if HAS_GGX_MODELS
#if HAS_ANISOTROPY
// lobeShares() of an anisotropic lobe, by sampling microfacets that are visible to the viewer: no table holds two
// alphas. docs/environment.md states the error. The golden ratio spreads points evenly; steep microfacets, which vary
// most, are sampled more densely.
vec2 sharesOfTwoAlphas(SeenSurface seen)
{
    const int kFacets = 24;
    const float kGoldenShare = 0.618033989;
    Surface surface = seen.surface;
    vec2 alpha = vec2(surface.alpha, surface.alphaBitangent);
    precise vec2 sum = vec2(0.0);
    for (int k = 0; k < kFacets; ++k) {
        precise float inward = (float(k) + 0.5) / float(kFacets);
        precise vec2 point = vec2(1.0 - inward * inward, fract(0.5 + float(k) * kGoldenShare));
        vec3 toLight = visibleReflection(point, alpha, seen.toViewer, surface.normalLS, surface.tangentLS);
        precise float nl = dot(surface.normalLS, toLight);
        if (!(nl > 0.0)) continue;
        Directions directions = directionsOn(seen, toLight, nl);
        // D V n.l over the densities of the microfacets, G1(v) D / (4 n.v), and of the points.
        precise float share = 4.0 * inward * visibilityOfMetallicRoughness(seen, directions) * nl
                              * (seen.nv + seen.viewerLength);
        precise float rise = 1.0 - directions.lh, rise2 = rise * rise;
        sum += share * vec2(1.0, rise2 * rise2 * rise);
    }
    precise vec2 mean = sum * (1.0 / float(kFacets));
    return mean;
}
#endif

// Reflectance of a metallic_roughness lobe under uniform illumination: x per f0, y per fresnelRise.
vec2 lobeShares(SeenSurface seen)
{
#if HAS_ANISOTROPY
    if (seen.nv > 0.0 && isAnisotropic(seen.surface)) return sharesOfTwoAlphas(seen);
#endif
    return lobeTexel(max(seen.nv, 0.0), lobeAlpha(seen.surface), LOBE_LAYER_GGX).rg;
}
#endif

#if ENVIRONMENT_COMPENSATION && HAS_GGX_MODELS
// Compensation for multiple scattering in a rough, isotropic lobe of metallic_roughness: the fraction of the irradiance
// that its BRDF loses and that leaves diffusely. Source: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for
// Real-Time Image-based Lighting".
vec3 lostToBounces(SeenSurface seen)
{
    if (SPECULAR_OFF != 0 || !HAS_METALLIC(seen.surface.model) || !(seen.nv > 0.0)) return vec3(0.0);
#if HAS_TANGENT_FRAME
    if (isAnisotropic(seen.surface)) return vec3(0.0); // the table has one alpha
#endif
#if HAS_MIRRORS
    if (isMirror(seen)) return vec3(0.0);
#endif
    vec2 lobe = lobeShares(seen);
    precise vec3 once = seen.f0 * lobe.x + seen.fresnelRise * lobe.y;
    precise vec3 mean = min(seen.f0 + seen.fresnelRise * (1.0 / 21.0), vec3(1.0)); // of the Fresnel factor
    precise float lost = max(1.0 - lobe.x, 0.0);
    precise vec3 back = once * mean * lost / (1.0 - mean * lost);
    return back;
}
#endif
