// Reflectance of a surface under illumination that is uniform over each of its lobes: radiance towards the viewer is
// the sum of these weights times the entering irradiance, the irradiance on the surface, and the radiance on each lobe.
#pragma once
#include "lib/reflectance/lobes.glsl"
#include "lib/reflectance/mirrors.glsl"

struct EvenShares {
    vec3 ofEntering;   // of the irradiance that enters the surface, including wrapped light around the horizon
    vec3 ofIrradiance; // of the irradiance on the surface, in addition
    vec3 ofLobe;       // of the radiance incident on its lobe; 0 without a lobe
#if HAS_CLEARCOAT
    vec3 ofCoat;
#endif
};

#if HAS_MIRRORS && HAS_GGX_MODELS
// Blends the table's value towards Fresnel's factor by the mirror weight, which is more accurate than interpolation.
vec3 towardsMirror(SeenSurface seen, vec3 reflected)
{
    float share = mirrorShare(lobeAlpha(seen.surface));
    precise vec3 blended = reflected * (1.0 - share) + mirrorReflectance(seen) * share;
    return blended;
}
#endif

#if HAS_GGX_MODELS
// Reflectance of a dielectric lobe under uniform illumination, by parabolas through three indices on one side of 1.
float reflectedByDielectric(SeenSurface seen)
{
    float ior = seen.surface.iorOrF90;
    float number = iorPlace(ior);
    bool isDenser = ior >= 1.0;
    int first = isDenser ? min(int(number), LOBE_TABLE_IORS - 3) : min(max(int(number), 0), LOBE_TABLE_IOR_ONE - 2);
    precise float t = number - float(first);
    precise vec3 shares = vec3(0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0));
    vec2 place = vec2(lobeColumn(ior, clamp(seen.nv, 0.0, 1.0)), sqrt(clamp(lobeAlpha(seen.surface), 0.0, 1.0)));
    // Below index 1 the reflectance is 0 at 1; the table's value there is for indices above.
    int count = !isDenser && first == LOBE_TABLE_IOR_ONE - 2 ? 2 : 3;
    precise float reflected = 0.0;
    for (int i = 0; i < count; ++i)
        reflected += shares[i] * lobeTexelAt(place, LOBE_LAYER_DIELECTRIC + (first + i) / 4)[(first + i) % 4];
    if (isDenser) {
        precise float root = lobeTexelAt(place, LOBE_LAYER_SHEEN).b;
        precise float incidence = root * root;
        reflected *= fresnelDielectric(ior, incidence);
    }
    return clamp(reflected, 0.0, 1.0);
}

void addMetallicRoughness(SeenSurface seen, const bool fromAllAround, inout EvenShares shares)
{
    Surface surface = seen.surface;
    float coupled = lobeTexel(max(seen.nv, 0.0), lobeAlpha(surface), LOBE_LAYER_GGX).a;
    precise vec3 entering = seen.diffuse * (vec3(1.0) - seen.f0 - seen.fresnelRise * coupled);
    precise vec3 highlight = vec3(0.0);
    if (hasLobe(seen)) {
        vec2 lobe = lobeShares(seen);
        highlight = seen.f0 * lobe.x + seen.fresnelRise * lobe.y;
    }
#if HAS_MIRRORS
    if (fromAllAround && hasLobe(seen)) highlight = towardsMirror(seen, highlight);
#endif
    precise vec3 besides = vec3(0.0);
#if ENVIRONMENT_COMPENSATION
    if (fromAllAround) besides = lostToBounces(seen) * kInversePi;
#endif
#if HAS_SHEEN
    if (strongestSheen(surface) > 0.0) {
        vec2 sheen = lobeTexel(max(seen.nv, 0.0), surface.sheenAlpha, LOBE_LAYER_SHEEN).rg;
        entering *= max(1.0 - strongestSheen(surface) * sheen.g, 0.0);
        float below = viewerShareUnderSheen(seen);
        highlight *= below;
        besides *= below;
        // A sheen is as broad as a diffuse reflection.
        if (hasLobe(seen)) besides += surface.sheenColor * sheen.r * kInversePi;
    }
#endif
    shares.ofEntering = entering;
    shares.ofIrradiance = besides;
    shares.ofLobe = highlight;
}
#endif

void addTeachingModels(SeenSurface seen, const bool fromAllAround, inout EvenShares shares)
{
    shares.ofEntering = seen.surface.albedo;
    if (!hasLobe(seen)) return;
#if HAS_BLINN_PHONG
    if (seen.surface.model == MODEL_BLINN_PHONG) {
        // The table holds the reflectance times p + 2, which hardly changes with p.
        precise float reflected =
            lobeTexel(seen.nv, lobeAlpha(seen.surface), LOBE_LAYER_GGX).b / (seen.surface.parameter + 2.0);
        precise vec3 highlight = seen.surface.specular * reflected;
        shares.ofLobe = highlight;
    }
#endif
#if HAS_GGX_MODELS
    if (IS_MICROFACET(seen.surface.model)) {
        precise vec3 highlight = seen.surface.specular * reflectedByDielectric(seen);
#if HAS_MIRRORS
        if (fromAllAround) highlight = towardsMirror(seen, highlight);
#endif
        shares.ofLobe = highlight;
    }
#endif
}

// `fromAllAround`: light of an environment instead of an area light: lobes may be mirrors, and energy lost between
// microfacets is compensated if requested.
EvenShares evenShares(SeenSurface seen, const bool fromAllAround)
{
    EvenShares shares;
    shares.ofEntering = shares.ofIrradiance = shares.ofLobe = vec3(0.0);
    bool isMetallic = false;
#if HAS_GGX_MODELS
    isMetallic = HAS_METALLIC(seen.surface.model);
    if (isMetallic) addMetallicRoughness(seen, fromAllAround, shares);
#endif
    if (!isMetallic) addTeachingModels(seen, fromAllAround, shares);
#if HAS_CLEARCOAT
    shares.ofCoat = vec3(0.0);
    if (seen.surface.coatFactor > 0.0) {
        precise float below = 1.0 - seen.coatWeight;
        shares.ofEntering *= below;
        shares.ofIrradiance *= below;
        shares.ofLobe *= below;
#if !SPECULAR_OFF
        if (seen.coatNv > 0.0) {
            precise float whole = lobeTexel(seen.coatNv, seen.surface.coatAlpha, LOBE_LAYER_GGX).r;
#if HAS_MIRRORS
            if (fromAllAround) {
                float share = mirrorShare(seen.surface.coatAlpha);
                whole = whole * (1.0 - share) + share;
            }
#endif
            precise vec3 coat = vec3(seen.coatWeight * whole);
            shares.ofCoat = coat;
        }
#endif
    }
#endif
    return shares;
}
