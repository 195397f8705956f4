// BRDF times cosine of a surface for one light direction: a function per model, selected by reflection(), and the
// layers above the models, for all techniques.
#pragma once
#include "lib/reflectance/brdf.glsl"
#include "lib/maths/octahedral.glsl"
#include "lib/reflectance/sheen.glsl"
#include "lib/reflectance/subsurface.glsl"
#include "lib/surface/surface.glsl"

#ifndef SPECULAR_OFF
#define SPECULAR_OFF 0
#endif

// The factors of the specular lobe, kept separate for their debug views.
struct SpecularTerms {
    float d;  // distribution of normals, 1/sr; the whole highlight of blinn_phong
    float v;  // G / (4 n.l n.v)
    vec3 f;   // Fresnel reflectance
};
const SpecularTerms kNoTerms = SpecularTerms(0.0, 0.0, vec3(0.0));

#if HAS_TANGENT_FRAME
bool isAnisotropic(Surface surface)
{
    if (HAS_TWO_ALPHAS(surface.model)) return true;
#if HAS_ANISOTROPY
    // Equal alphas use the isotropic functions, so that anisotropic materials change no bit of isotropic ones.
    return HAS_ANISOTROPY_STRENGTH(surface.model) && surface.alphaBitangent != surface.alpha;
#else
    return false;
#endif
}
#endif

// A surface and a viewer: values that are the same for every light. They are computed before the loop over lights,
// because not every driver's compiler moves work out of a loop.
struct SeenSurface {
    Surface surface;
    vec3 toViewer; // unit
    float nv;
#if HAS_GGX_MODELS
    float alpha2;
    float scale;        // ggxScale()
    float viewerLength; // Smith length of the viewer, for directional masking-shadowing or a single alpha
    vec3 f0;            // of metallic models
    vec3 fresnelRise;   // from f0 to f90
    vec3 diffuse;       // diffuse BRDF of metallic models where F is 0, 1/sr
#endif
#if HAS_CLEARCOAT
    vec3 coatNormalLS;
    float coatNv;
    float coatWeight; // of the coat's lobe; the layers below have the rest
#endif
};

// Smith length of a direction; `cosine`: to the normal.
float lobeLength(Surface surface, vec3 direction, float cosine)
{
#if HAS_TANGENT_FRAME
    if (isAnisotropic(surface)) {
        vec2 alpha = vec2(surface.alpha, surface.alphaBitangent);
        return smithLengthAnisotropic(alpha, surface.normalLS, surface.tangentLS, direction);
    }
#endif
    return smithLength(surface.alpha * surface.alpha, cosine);
}

SeenSurface seenSurface(Surface surface, vec3 toViewer)
{
    SeenSurface seen;
    seen.surface = surface;
    seen.toViewer = toViewer;
    precise float nv = dot(surface.normalLS, toViewer);
    seen.nv = nv;
#if HAS_GGX_MODELS
    precise float alpha2 = surface.alpha * surface.alpha;
    seen.alpha2 = alpha2;
    seen.scale = ggxScale(alpha2);
    seen.viewerLength = lobeLength(surface, toViewer, nv);
    precise vec3 f0 = surface.specular + (surface.albedo - surface.specular) * surface.metallic;
    precise vec3 rise = (surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic) - f0;
    precise vec3 diffuse = surface.albedo * ((1.0 - surface.metallic) * kInversePi);
#if HAS_PASSING_LIGHT
    diffuse *= 1.0 - surface.transmission;
#endif
    seen.f0 = f0;
    seen.fresnelRise = rise;
    seen.diffuse = diffuse;
#endif
#if HAS_CLEARCOAT
    // Source: KHR_materials_clearcoat, "Layering": by the angle to the coat's normal, not to the half vector.
    seen.coatNormalLS = decodeOctahedral(surface.coatNormalCode);
    precise float coatNv = dot(seen.coatNormalLS, toViewer);
    seen.coatNv = coatNv;
    precise float weight = surface.coatFactor * fresnelSchlick(vec3(0.04), vec3(0.96), abs(coatNv)).x;
    seen.coatWeight = weight;
#endif
    return seen;
}

// Whether the model has a lobe that the viewer sees, not counting the coat's.
bool hasLobe(SeenSurface seen)
{
#if HAS_GLOSSY_MODELS
    return SPECULAR_OFF == 0 && IS_GLOSSY(seen.surface.model) && seen.nv > 0.0;
#else
    return false;
#endif
}

// Directions to a light and a viewer from a surface.
struct Directions {
    vec3 toLight; // unit
    HalfSum h;
    float nl; // cosines; n.l is 0 for a light below the horizon, where a model's functions must still be finite
    float nv;
    float lh;     // takes its grazing value where l = -v, so that the diffuse weight 1 - F stays continuous
    bool hasLobe; // both above the horizon, and not opposite
};

Directions directionsOn(SeenSurface seen, vec3 toLight, float nl)
{
    HalfSum h = halfSum(seen.surface.normalLS, toLight, seen.toViewer);
    return Directions(toLight, h, nl, seen.nv, halfCosine(h), nl > 0.0 && seen.nv > 0.0 && h.length2 > 0.0);
}

#if HAS_GGX_MODELS
float lobeDistribution(SeenSurface seen, HalfSum h)
{
#if HAS_TANGENT_FRAME
    Surface surface = seen.surface;
    if (isAnisotropic(surface)) {
        return distributionGgxAnisotropic(vec2(surface.alpha, surface.alphaBitangent), surface.normalLS, surface.tangentLS, h);
    }
#endif
    return distributionGgx(seen.alpha2, seen.scale, h);
}

// Visibility of metallic_roughness: height-correlated, directional if anisotropic (KHR_materials_anisotropy).
float visibilityOfMetallicRoughness(SeenSurface seen, Directions directions)
{
    float lightLength = lobeLength(seen.surface, directions.toLight, directions.nl);
    return visibilityCorrelated(directions.nl, lightLength, directions.nv, seen.viewerLength);
}

// Visibility of the teaching models: separable, by the surface's masking-shadowing option.
float visibilityOfMicrofacet(SeenSurface seen, Directions directions)
{
    Surface surface = seen.surface;
    float alpha2 = seen.alpha2;
    float viewerLength = seen.viewerLength;
#if HAS_TANGENT_FRAME
    if (HAS_TWO_ALPHAS(surface.model)) {
#if HAS_MASKING_OPTIONS
        if (surface.masking == MASKING_DIRECTIONAL) {
            float lightLength = lobeLength(surface, directions.toLight, directions.nl);
            return visibilitySeparable(directions.nl, lightLength, directions.nv, viewerLength);
        }
#endif
        alpha2 = alpha2Along(vec2(surface.alpha, surface.alphaBitangent), surface.normalLS, surface.tangentLS, directions.h);
        viewerLength = smithLength(alpha2, directions.nv);
    }
#endif
#if HAS_MASKING_OPTIONS
    if (surface.masking == MASKING_HALF_VECTOR)
        return visibilityHalfVector(alpha2, directions.nl, directions.nv, directions.lh);
#endif
    return visibilitySeparable(directions.nl, smithLength(alpha2, directions.nl), directions.nv, viewerLength);
}
#endif

#if HAS_SHEEN
float strongestSheen(Surface surface)
{
    return max(max(surface.sheenColor.r, surface.sheenColor.g), surface.sheenColor.b);
}

// Fraction of the layers below that a sheen leaves: 1 minus the directional albedo of a white sheen times the sheen's
// brightest channel. Source: KHR_materials_sheen, "Albedo-scaling technique".
float shareUnderSheen(Surface surface, Directions directions)
{
    precise float albedo =
        max(sheenAlbedo(surface.sheenAlpha, directions.nl), sheenAlbedo(surface.sheenAlpha, max(directions.nv, 0.0)));
    precise float share = max(1.0 - strongestSheen(surface) * albedo, 0.0);
    return share;
}

// The same for light at the viewer's angle, or whose direction does not matter.
float viewerShareUnderSheen(SeenSurface seen)
{
    precise float albedo = sheenAlbedo(seen.surface.sheenAlpha, max(seen.nv, 0.0));
    precise float share = max(1.0 - strongestSheen(seen.surface) * albedo, 0.0);
    return share;
}

vec3 underSheen(Surface surface, vec3 brdf, Directions directions)
{
    if (!(strongestSheen(surface) > 0.0)) return brdf;
    precise vec3 layered = brdf * shareUnderSheen(surface, directions);
#if !SPECULAR_OFF
    if (directions.hasLobe) {
        precise float lobe = distributionCharlie(surface.sheenAlpha, directions.h)
                             * visibilityCharlie(surface.sheenAlpha, directions.nl, directions.nv);
        layered += surface.sheenColor * lobe;
    }
#endif
    return layered;
}
#endif

// Reflection of light by a model; lights below the horizon have n.l = 0.
struct Reflection {
    vec3 brdfCosine;     // BRDF times cosine, 1/sr: reflected radiance per irradiance at normal incidence
    SpecularTerms terms; // 0 without a lobe
#if HAS_ENTERING_LIGHT
    vec3 diffuse; // BRDF of the light that enters the surface, 1/sr
#endif
};
#if HAS_ENTERING_LIGHT
#define REFLECTION(brdfCosine, terms, diffuse) Reflection(brdfCosine, terms, diffuse)
#else
#define REFLECTION(brdfCosine, terms, diffuse) Reflection(brdfCosine, terms)
#endif

// Source: Lambert 1760, "Photometria". k_d without 1/pi, as in the teaching models.
Reflection lambert(Surface surface, Directions directions)
{
    precise vec3 brdfCosine = surface.albedo * directions.nl;
    return REFLECTION(brdfCosine, kNoTerms, surface.albedo);
}

// Source: Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures".
Reflection blinnPhong(Surface surface, Directions directions)
{
    SpecularTerms terms = kNoTerms;
    if (directions.hasLobe) terms.d = blinnPhongLobe(surface.parameter, directions.h);
    precise float highlight = SPECULAR_OFF != 0 ? 0.0 : terms.d;
    precise vec3 brdfCosine = surface.albedo * directions.nl + surface.specular * highlight; // no cosine
    return REFLECTION(brdfCosine, terms, surface.albedo);
}

#if HAS_GGX_MODELS
// microfacet and microfacet_anisotropic; `d` is lobeDistribution(). Source: Cook and Torrance 1982 with the D, G and F
// of Walter et al. 2007.
Reflection microfacet(SeenSurface seen, Directions directions, float d)
{
    Surface surface = seen.surface;
    SpecularTerms terms = SpecularTerms(d, 0.0, vec3(fresnelDielectric(surface.iorOrF90, directions.lh)));
    if (directions.hasLobe) terms.v = visibilityOfMicrofacet(seen, directions);
    precise float dv = SPECULAR_OFF != 0 ? 0.0 : terms.d * terms.v;
    precise vec3 brdfCosine = (surface.albedo + surface.specular * (terms.f * dv)) * directions.nl;
    return REFLECTION(brdfCosine, terms, surface.albedo);
}

// Source: glTF 2.0, appendix B, with KHR_materials_ior, _specular, _anisotropy and _sheen.
Reflection metallicRoughness(SeenSurface seen, Directions directions, float d)
{
    SpecularTerms terms = SpecularTerms(d, 0.0, fresnelSchlick(seen.f0, seen.fresnelRise, directions.lh));
    if (directions.hasLobe) terms.v = visibilityOfMetallicRoughness(seen, directions);
    precise float dv = SPECULAR_OFF != 0 ? 0.0 : terms.d * terms.v;
    precise vec3 brdf = seen.diffuse + terms.f * (vec3(dv) - seen.diffuse); // diffuse (1 - F) + F D V
#if HAS_SHEEN
    brdf = underSheen(seen.surface, brdf, directions);
#endif
#if HAS_ENTERING_LIGHT
    precise vec3 entering = seen.diffuse * (vec3(1.0) - terms.f);
#if HAS_SHEEN
    entering *= shareUnderSheen(seen.surface, directions);
#endif
#endif
    precise vec3 reflected = brdf * directions.nl;
    return REFLECTION(reflected, terms, entering);
}
#endif

Reflection reflection(SeenSurface seen, Directions directions)
{
#if HAS_GGX_MODELS
    // Computed once for all models, since rasterisers that mask lanes take every branch.
    float d = directions.hasLobe ? lobeDistribution(seen, directions.h) : 0.0;
#endif
#if HAS_BLINN_PHONG
    if (seen.surface.model == MODEL_BLINN_PHONG) return blinnPhong(seen.surface, directions);
#endif
#if HAS_GGX_MODELS
    if (IS_MICROFACET(seen.surface.model)) return microfacet(seen, directions, d);
    if (HAS_METALLIC(seen.surface.model)) return metallicRoughness(seen, directions, d);
#endif
    return lambert(seen.surface, directions);
}

// BRDF times cosine of the layers below the coat.
vec3 baseBrdfCosine(SeenSurface seen, vec3 toLight)
{
#if HAS_SUBSURFACE_ROWS
    precise float cosine = dot(seen.surface.normalLS, toLight);
    Reflection reflected = reflection(seen, directionsOn(seen, toLight, max(cosine, 0.0)));
    precise vec3 brdfCosine = reflected.brdfCosine;
#if HAS_SUBSURFACE_WRAP
    brdfCosine += reflected.diffuse * wrappedExcess(seen.surface, cosine);
#endif
    return brdfCosine;
#else
    precise float nl = max(dot(seen.surface.normalLS, toLight), 0.0);
    return reflection(seen, directionsOn(seen, toLight, nl)).brdfCosine;
#endif
}

#if HAS_CLEARCOAT
vec3 underCoat(SeenSurface seen, vec3 base, vec3 toLight)
{
    if (!(seen.surface.coatFactor > 0.0)) return base;
    precise vec3 coated = base * (1.0 - seen.coatWeight);
#if !SPECULAR_OFF
    precise float nl = dot(seen.coatNormalLS, toLight);
    HalfSum h = halfSum(seen.coatNormalLS, toLight, seen.toViewer);
    if (nl > 0.0 && seen.coatNv > 0.0 && h.length2 > 0.0) {
        precise float alpha2 = seen.surface.coatAlpha * seen.surface.coatAlpha;
        precise float lobe =
            distributionGgx(alpha2, ggxScale(alpha2), h)
            * visibilityCorrelated(nl, smithLength(alpha2, nl), seen.coatNv, smithLength(alpha2, seen.coatNv)) * nl;
        coated += vec3(seen.coatWeight * lobe);
    }
#endif
    return coated;
}
#endif

// BRDF times cosine of all layers: radiance towards the viewer per irradiance at normal incidence.
vec3 layeredBrdfCosine(SeenSurface seen, vec3 toLight)
{
    precise vec3 brdfCosine = baseBrdfCosine(seen, toLight);
#if HAS_CLEARCOAT
    brdfCosine = underCoat(seen, brdfCosine, toLight);
#endif
    return brdfCosine;
}

#if HAS_SUBSURFACE_PASSAGE
// The same for light from below the horizon that is transmitted, as through a plate: it leaves at the angle at which it
// entered on the other side.
vec3 passingBrdfCosine(SeenSurface seen, vec3 toLight)
{
    precise float cosine = dot(seen.surface.normalLS, toLight);
    if (cosine >= 0.0 || !letsLightThrough(seen.surface)) return vec3(0.0);
    precise vec3 brdfCosine = reflection(seen, directionsOn(seen, toLight, 0.0)).diffuse * -cosine;
#if HAS_CLEARCOAT
    if (seen.surface.coatFactor > 0.0) brdfCosine *= 1.0 - seen.coatWeight;
#endif
    return brdfCosine;
}
#endif

// Emitted radiance towards the viewer. Source: KHR_materials_clearcoat, "Emission": it lies below the coat.
vec3 emittedRadiance(SeenSurface seen)
{
    precise vec3 emitted = seen.surface.emission;
#if HAS_CLEARCOAT && HAS_EMISSION
    if (seen.surface.coatFactor > 0.0) {
        precise vec3 dimmed = emitted * (1.0 - seen.coatWeight);
        emitted = dimmed;
    }
#endif
    return emitted;
}
