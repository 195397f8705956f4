// What lobes reflect of even light, by the table renderer/frame/LobeTable.h.
#pragma once
#include "shared/lobe_table.h"
#include "lib/reflectance/mirrors.glsl"
#include "lib/reflectance/reflectance.glsl"

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

// Of a lobe that is as wide as the surface's; one alpha in place of two, where the table has no more.
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
        // Slopes of facets vary by the square of alpha, so that this is their mean over all azimuths.
        precise float mean2 = 0.5 * (surface.alpha * surface.alpha + surface.alphaBitangent * surface.alphaBitangent);
        precise float mean = sqrt(mean2);
        return mean;
    }
#endif
    return surface.alpha;
}

#if ENVIRONMENT_COMPENSATION && HAS_GGX_MODELS
// Light that meets a rough lobe of metallic_roughness of one alpha more than once, which its BRDF loses: the part that comes
// out again, to all sides alike, of the irradiance. Source: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time
// Image-based Lighting".
vec3 lostToBounces(SeenSurface seen)
{
    if (SPECULAR_OFF != 0 || !HAS_METALLIC(seen.surface.model) || !(seen.nv > 0.0)) return vec3(0.0);
#if HAS_TANGENT_FRAME
    if (isAnisotropic(seen.surface)) return vec3(0.0); // the table knows one alpha
#endif
#if HAS_MIRRORS
    if (isMirror(seen)) return vec3(0.0);
#endif
    vec4 lobe = lobeTexel(seen.nv, lobeAlpha(seen.surface), LOBE_LAYER_GGX);
    precise vec3 once = seen.f0 * lobe.r + seen.fresnelRise * lobe.g;
    precise vec3 mean = min(seen.f0 + seen.fresnelRise * (1.0 / 21.0), vec3(1.0)); // of the Fresnel factor
    precise float lost = max(1.0 - lobe.r, 0.0);
    precise vec3 back = once * mean * lost / (1.0 - mean * lost);
    return back;
}
#endif
