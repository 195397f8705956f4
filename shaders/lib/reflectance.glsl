// What one light direction gives on one surface: the models, and the layers of metallic_roughness, once for all techniques.
#pragma once
#include "lib/brdf.glsl"
#include "lib/octahedral.glsl"
#include "lib/sheen.glsl"
#include "lib/surface.glsl"

// The factors of the specular lobe, kept apart for the views that show them.
struct SpecularTerms {
    float d;  // distribution of normals, 1/sr; the whole highlight of blinn_phong
    float v;  // G / (4 n.l n.v)
    vec3 f;   // Fresnel reflectance
};

// The half vector of two unit vectors. Where they are opposite there is none: false, and h is 0.
bool halfVector(vec3 toLight, vec3 toViewer, out vec3 h)
{
    precise vec3 sum = toLight + toViewer;
    precise float length2 = dot(sum, sum);
    precise vec3 unit = length2 > 0.0 ? sum / sqrt(length2) : vec3(0.0);
    h = unit;
    return length2 > 0.0;
}

#if HAS_TANGENT_FRAME
bool isAnisotropic(Surface surface)
{
#if HAS_MICROFACET_ANISOTROPIC
    if (surface.model == MODEL_MICROFACET_ANISOTROPIC) return true;
#endif
#if HAS_ANISOTROPY
    // Equal alphas take the isotropic functions, so that other materials keep their bits in a scene with anisotropic ones.
    return surface.model == MODEL_METALLIC_ROUGHNESS && surface.alphaBitangent != surface.alpha;
#else
    return false;
#endif
}
#endif

float lobeDistribution(Surface surface, vec3 h)
{
#if HAS_TANGENT_FRAME
    if (isAnisotropic(surface)) {
        return distributionGgxAnisotropic(vec2(surface.alpha, surface.alphaBitangent), surface.normalLS, surface.tangentLS, h);
    }
#endif
    return distributionGgx(surface.alpha, surface.normalLS, h);
}

#if HAS_METALLIC_ROUGHNESS
// Of metallic_roughness: height-correlated, directional where anisotropic (KHR_materials_anisotropy).
float visibilityOfMetallicRoughness(Surface surface, vec3 toLight, vec3 toViewer, float nl, float nv)
{
#if HAS_ANISOTROPY
    if (isAnisotropic(surface)) {
        vec2 alpha = vec2(surface.alpha, surface.alphaBitangent);
        return visibilityCorrelatedOfLengths(
            nl, smithLengthAnisotropic(alpha, surface.normalLS, surface.tangentLS, toLight), nv,
            smithLengthAnisotropic(alpha, surface.normalLS, surface.tangentLS, toViewer));
    }
#endif
    return visibilityCorrelated(surface.alpha, nl, nv);
}
#endif

#if HAS_MICROFACET || HAS_MICROFACET_ANISOTROPIC
// Of the teaching models: separable, by the surface's masking option.
float visibilityOfMicrofacet(Surface surface, vec3 toLight, vec3 toViewer, vec3 h, float nl, float nv)
{
    precise float alpha = surface.alpha;
#if HAS_MICROFACET_ANISOTROPIC
    if (surface.model == MODEL_MICROFACET_ANISOTROPIC) {
        vec2 alphas = vec2(surface.alpha, surface.alphaBitangent);
#if HAS_MASKING_OPTIONS
        if (surface.masking == MASKING_DIRECTIONAL) {
            return visibilitySeparableOfLengths(
                nl, smithLengthAnisotropic(alphas, surface.normalLS, surface.tangentLS, toLight), nv,
                smithLengthAnisotropic(alphas, surface.normalLS, surface.tangentLS, toViewer));
        }
#endif
        alpha = alphaAlong(alphas, surface.normalLS, surface.tangentLS, h);
    }
#endif
#if HAS_MASKING_OPTIONS
    if (surface.masking == MASKING_HALF_VECTOR) return visibilityHalfVector(alpha, nl, nv, dot(toLight, h));
#endif
    return visibilitySeparable(alpha, nl, nv);
}
#endif

// d and v are 0 where the lobe is: l or v below the horizon, or l = -v. The Fresnel factor needs only the angle between l and h and
// goes on to its grazing value where l = -v, so that the diffuse share 1 - F stays continuous.
SpecularTerms specularTerms(Surface surface, vec3 toLight, vec3 toViewer, float nl)
{
    SpecularTerms terms = SpecularTerms(0.0, 0.0, vec3(0.0));
    vec3 h;
    bool hasHalf = halfVector(toLight, toViewer, h);
    precise float lh = dot(toLight, h);
    precise float nv = dot(surface.normalLS, toViewer);
    bool glossy = nl > 0.0 && nv > 0.0 && hasHalf;
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) {
        if (glossy) terms.d = blinnPhongLobe(surface.exponent, surface.normalLS, h);
        return terms;
    }
#endif
    if (glossy) terms.d = lobeDistribution(surface, h);
#if HAS_METALLIC_ROUGHNESS
    if (surface.model == MODEL_METALLIC_ROUGHNESS) {
        precise vec3 f0 = surface.specular + (surface.albedo - surface.specular) * surface.metallic;
        precise float f90 = surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic;
        terms.f = fresnelSchlick(f0, f90, lh);
        if (glossy) terms.v = visibilityOfMetallicRoughness(surface, toLight, toViewer, nl, nv);
    }
#endif
#if HAS_MICROFACET || HAS_MICROFACET_ANISOTROPIC
    if (isMicrofacet(surface.model)) {
        terms.f = vec3(fresnelDielectric(surface.iorOrF90, lh));
        if (glossy) terms.v = visibilityOfMicrofacet(surface, toLight, toViewer, h, nl, nv);
    }
#endif
    return terms;
}

#if HAS_SHEEN
// The sheen over the rest of the material, which it darkens by what a white sheen of its brightest colour would reflect.
// Source: KHR_materials_sheen, "Albedo-scaling technique".
vec3 underSheen(Surface surface, vec3 share, vec3 toLight, vec3 toViewer, float nl)
{
    precise float strongest = max(max(surface.sheenColor.r, surface.sheenColor.g), surface.sheenColor.b);
    if (!(strongest > 0.0)) return share;
    precise float nv = dot(surface.normalLS, toViewer);
    precise float albedo = max(sheenAlbedo(surface.sheenAlpha, nl), sheenAlbedo(surface.sheenAlpha, max(nv, 0.0)));
    precise vec3 layered = share * max(1.0 - strongest * albedo, 0.0);
#if !SPECULAR_OFF
    vec3 h;
    if (nv > 0.0 && halfVector(toLight, toViewer, h)) {
        precise float lobe = distributionCharlie(surface.sheenAlpha, surface.normalLS, h)
                             * visibilityCharlie(surface.sheenAlpha, nl, nv);
        layered += surface.sheenColor * lobe;
    }
#endif
    return layered;
}
#endif

// Radiance towards the viewer for one unit of incident intensity, below the coat: the model's BRDF times max(0, n.l).
vec3 baseShare(Surface surface, vec3 toLight, vec3 toViewer)
{
    precise float nl = dot(surface.normalLS, toLight);
    if (!(nl > 0.0)) return vec3(0.0);
    precise vec3 share = surface.albedo; // k_d of the teaching models, which carry no 1/pi
#if HAS_GLOSSY_MODELS
    SpecularTerms terms = specularTerms(surface, toLight, toViewer, nl);
#if SPECULAR_OFF
    precise float dv = 0.0;
#else
    precise float dv = terms.d * terms.v;
#endif
#if HAS_METALLIC_ROUGHNESS
    if (surface.model == MODEL_METALLIC_ROUGHNESS) {
        precise vec3 transmitted = vec3(1.0) - terms.f;
        precise vec3 diffuse = transmitted * ((1.0 - surface.metallic) / kPi) * surface.albedo;
        share = diffuse + terms.f * dv;
#if HAS_SHEEN
        share = underSheen(surface, share, toLight, toViewer, nl);
#endif
    }
#endif
#if HAS_MICROFACET || HAS_MICROFACET_ANISOTROPIC
    if (isMicrofacet(surface.model)) share = surface.albedo + surface.specular * (terms.f * dv);
#endif
#if HAS_BLINN_PHONG && !SPECULAR_OFF
    if (surface.model == MODEL_BLINN_PHONG) {
        precise vec3 lit = surface.albedo * nl + surface.specular * terms.d; // the highlight takes no cosine
        return lit;
    }
#endif
#endif
    precise vec3 reflected = share * nl;
    return reflected;
}

#if HAS_CLEARCOAT
// The share of the view that the coat reflects instead of the material below. Source: KHR_materials_clearcoat, "Layering": by
// the angle to the coat's normal, not to the half vector.
float coatWeight(Surface surface, vec3 coatNormalLS, vec3 toViewer)
{
    precise float weight = surface.coatFactor * fresnelSchlick(vec3(0.04), 1.0, abs(dot(coatNormalLS, toViewer))).x;
    return weight;
}

vec3 underCoat(Surface surface, vec3 base, vec3 toLight, vec3 toViewer)
{
    if (!(surface.coatFactor > 0.0)) return base;
    vec3 normalLS = decodeOctahedral(surface.coatNormalCode);
    precise float weight = coatWeight(surface, normalLS, toViewer);
    precise vec3 coated = base * (1.0 - weight);
#if !SPECULAR_OFF
    precise float nl = dot(normalLS, toLight);
    precise float nv = dot(normalLS, toViewer);
    vec3 h;
    if (nl > 0.0 && nv > 0.0 && halfVector(toLight, toViewer, h)) {
        precise float lobe =
            distributionGgx(surface.coatAlpha, normalLS, h) * visibilityCorrelated(surface.coatAlpha, nl, nv) * nl;
        coated += vec3(weight * lobe);
    }
#endif
    return coated;
}
#endif

// Radiance towards the viewer for one unit of incident intensity.
vec3 reflectedShare(Surface surface, vec3 toLight, vec3 toViewer)
{
    precise vec3 share = baseShare(surface, toLight, toViewer);
#if HAS_CLEARCOAT
    share = underCoat(surface, share, toLight, toViewer);
#endif
    return share;
}

// Radiance towards the viewer without any light. Source: KHR_materials_clearcoat, "Emission": it lies below the coat.
vec3 emittedRadiance(Surface surface, vec3 toViewer)
{
    precise vec3 emitted = surface.emission;
#if HAS_CLEARCOAT && HAS_EMISSION
    if (surface.coatFactor > 0.0) {
        precise vec3 dimmed = emitted * (1.0 - coatWeight(surface, decodeOctahedral(surface.coatNormalCode), toViewer));
        emitted = dimmed;
    }
#endif
    return emitted;
}
