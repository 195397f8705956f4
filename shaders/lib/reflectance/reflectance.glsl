// The BRDF times cosine of a surface for one light direction: a function per model, chosen by reflection(), and the
// layers over the models, once for all techniques.
#pragma once
#include "lib/reflectance/brdf.glsl"
#include "lib/maths/octahedral.glsl"
#include "lib/reflectance/sheen.glsl"
#include "lib/surface/surface.glsl"

#ifndef SPECULAR_OFF
#define SPECULAR_OFF 0
#endif

// The factors of the specular lobe, kept apart for the views that show them.
struct SpecularTerms {
    float d;  // distribution of normals, 1/sr; the whole highlight of blinn_phong
    float v;  // G / (4 n.l n.v)
    vec3 f;   // Fresnel reflectance
};
const SpecularTerms kNoTerms = SpecularTerms(0.0, 0.0, vec3(0.0));

// The half vector of two unit vectors. Where they are opposite there is none: false, and h is 0.
bool halfVector(vec3 toLight, vec3 toViewer, out vec3 h)
{
    precise vec3 sum = toLight + toViewer;
    precise float length2 = dot(sum, sum);
    precise vec3 unit = length2 > 0.0 ? sum / sqrt(length2) : vec3(0.0);
    h = unit;
    return length2 > 0.0;
}

// A light and a viewer seen from a surface; all unit.
struct Directions {
    vec3 toLight;
    vec3 toViewer;
    vec3 h;       // halfway between them; 0 where they are opposite
    float nl;     // cosines
    float nv;
    float lh;     // takes its grazing value where l = -v, so that the diffuse weight 1 - F stays continuous
    bool hasLobe; // both above the horizon, and not opposite
};

Directions directionsOn(Surface surface, vec3 toLight, vec3 toViewer, float nl)
{
    vec3 h;
    bool hasHalf = halfVector(toLight, toViewer, h);
    precise float lh = dot(toLight, h);
    precise float nv = dot(surface.normalLS, toViewer);
    return Directions(toLight, toViewer, h, nl, nv, lh, nl > 0.0 && nv > 0.0 && hasHalf);
}

#if HAS_TANGENT_FRAME
bool isAnisotropic(Surface surface)
{
    if (HAS_TWO_ALPHAS(surface.model)) return true;
#if HAS_ANISOTROPY
    // Equal alphas take the isotropic functions, so that other materials keep their bits in a scene with anisotropic ones.
    return HAS_ANISOTROPY_STRENGTH(surface.model) && surface.alphaBitangent != surface.alpha;
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

// Of metallic_roughness: height-correlated, directional where anisotropic (KHR_materials_anisotropy).
float visibilityOfMetallicRoughness(Surface surface, Directions directions)
{
#if HAS_ANISOTROPY
    if (isAnisotropic(surface)) {
        vec2 alpha = vec2(surface.alpha, surface.alphaBitangent);
        return visibilityCorrelatedOfLengths(
            directions.nl, smithLengthAnisotropic(alpha, surface.normalLS, surface.tangentLS, directions.toLight), directions.nv,
            smithLengthAnisotropic(alpha, surface.normalLS, surface.tangentLS, directions.toViewer));
    }
#endif
    return visibilityCorrelated(surface.alpha, directions.nl, directions.nv);
}

// Of the teaching models: separable, by the surface's masking-shadowing option.
float visibilityOfMicrofacet(Surface surface, Directions directions)
{
    precise float alpha = surface.alpha;
#if HAS_TANGENT_FRAME
    if (HAS_TWO_ALPHAS(surface.model)) {
        vec2 alphas = vec2(surface.alpha, surface.alphaBitangent);
#if HAS_MASKING_OPTIONS
        if (surface.masking == MASKING_DIRECTIONAL) {
            return visibilitySeparableOfLengths(
                directions.nl, smithLengthAnisotropic(alphas, surface.normalLS, surface.tangentLS, directions.toLight),
                directions.nv, smithLengthAnisotropic(alphas, surface.normalLS, surface.tangentLS, directions.toViewer));
        }
#endif
        alpha = alphaAlong(alphas, surface.normalLS, surface.tangentLS, directions.h);
    }
#endif
#if HAS_MASKING_OPTIONS
    if (surface.masking == MASKING_HALF_VECTOR)
        return visibilityHalfVector(alpha, directions.nl, directions.nv, directions.lh);
#endif
    return visibilitySeparable(alpha, directions.nl, directions.nv);
}

#if HAS_SHEEN
// Puts the sheen over the layers below, and scales these by 1 minus the directional albedo of a white sheen times the
// sheen's brightest channel. Source: KHR_materials_sheen, "Albedo-scaling technique".
vec3 underSheen(Surface surface, vec3 brdf, Directions directions)
{
    precise float strongest = max(max(surface.sheenColor.r, surface.sheenColor.g), surface.sheenColor.b);
    if (!(strongest > 0.0)) return brdf;
    precise float albedo =
        max(sheenAlbedo(surface.sheenAlpha, directions.nl), sheenAlbedo(surface.sheenAlpha, max(directions.nv, 0.0)));
    precise vec3 layered = brdf * max(1.0 - strongest * albedo, 0.0);
#if !SPECULAR_OFF
    if (directions.hasLobe) {
        precise float lobe = distributionCharlie(surface.sheenAlpha, surface.normalLS, directions.h)
                             * visibilityCharlie(surface.sheenAlpha, directions.nl, directions.nv);
        layered += surface.sheenColor * lobe;
    }
#endif
    return layered;
}
#endif

// The reflection of light from above the horizon by a model.
struct Reflection {
    vec3 brdfCosine;     // BRDF times cosine, 1/sr: reflected radiance per irradiance at normal incidence
    SpecularTerms terms; // 0 where it has no lobe there
};

// Source: Lambert 1760, "Photometria". k_d without 1/pi, as the teaching models have it.
Reflection lambert(Surface surface, Directions directions)
{
    precise vec3 brdfCosine = surface.albedo * directions.nl;
    return Reflection(brdfCosine, kNoTerms);
}

// Source: Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures".
Reflection blinnPhong(Surface surface, Directions directions)
{
    SpecularTerms terms = kNoTerms;
    if (directions.hasLobe) terms.d = blinnPhongLobe(surface.parameter, surface.normalLS, directions.h);
    precise float highlight = SPECULAR_OFF != 0 ? 0.0 : terms.d;
    precise vec3 brdfCosine = surface.albedo * directions.nl + surface.specular * highlight; // which takes no cosine
    return Reflection(brdfCosine, terms);
}

// microfacet and microfacet_anisotropic; `d` is lobeDistribution(). Source: Cook and Torrance 1982 with the D, G and F of
// Walter et al. 2007.
Reflection microfacet(Surface surface, Directions directions, float d)
{
    SpecularTerms terms = SpecularTerms(d, 0.0, vec3(fresnelDielectric(surface.iorOrF90, directions.lh)));
    if (directions.hasLobe) terms.v = visibilityOfMicrofacet(surface, directions);
    precise float dv = SPECULAR_OFF != 0 ? 0.0 : terms.d * terms.v;
    precise vec3 brdfCosine = (surface.albedo + surface.specular * (terms.f * dv)) * directions.nl;
    return Reflection(brdfCosine, terms);
}

// Source: glTF 2.0, appendix B, with KHR_materials_ior, _specular, _anisotropy and _sheen.
Reflection metallicRoughness(Surface surface, Directions directions, float d)
{
    precise vec3 f0 = surface.specular + (surface.albedo - surface.specular) * surface.metallic;
    precise float f90 = surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic;
    SpecularTerms terms = SpecularTerms(d, 0.0, fresnelSchlick(f0, f90, directions.lh));
    if (directions.hasLobe) terms.v = visibilityOfMetallicRoughness(surface, directions);
    precise float dv = SPECULAR_OFF != 0 ? 0.0 : terms.d * terms.v;
    precise vec3 transmitted = vec3(1.0) - terms.f;
    precise vec3 diffuse = transmitted * ((1.0 - surface.metallic) / kPi) * surface.albedo;
    precise vec3 brdf = diffuse + terms.f * dv;
#if HAS_SHEEN
    brdf = underSheen(surface, brdf, directions);
#endif
    precise vec3 reflected = brdf * directions.nl;
    return Reflection(reflected, terms);
}

Reflection reflection(Surface surface, Directions directions)
{
#if HAS_GGX_MODELS
    // Once for all, since rasterisers that mask lanes take every branch.
    float d = directions.hasLobe ? lobeDistribution(surface, directions.h) : 0.0;
#endif
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) return blinnPhong(surface, directions);
#endif
#if HAS_GGX_MODELS
    if (IS_MICROFACET(surface.model)) return microfacet(surface, directions, d);
    if (HAS_METALLIC(surface.model)) return metallicRoughness(surface, directions, d);
#endif
    return lambert(surface, directions);
}

// BRDF times cosine of the layers below the coat.
vec3 baseBrdfCosine(Surface surface, vec3 toLight, vec3 toViewer)
{
    precise float nl = dot(surface.normalLS, toLight);
    if (!(nl > 0.0)) return vec3(0.0);
    return reflection(surface, directionsOn(surface, toLight, toViewer, nl)).brdfCosine;
}

#if HAS_CLEARCOAT
// The weight of the coat's lobe; the layers below have the rest. Source: KHR_materials_clearcoat, "Layering": by
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

// BRDF times cosine of all layers: radiance towards the viewer per irradiance at normal incidence.
vec3 layeredBrdfCosine(Surface surface, vec3 toLight, vec3 toViewer)
{
    precise vec3 brdfCosine = baseBrdfCosine(surface, toLight, toViewer);
#if HAS_CLEARCOAT
    brdfCosine = underCoat(surface, brdfCosine, toLight, toViewer);
#endif
    return brdfCosine;
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
