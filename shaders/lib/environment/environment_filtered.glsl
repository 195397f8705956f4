// Environment lighting from prefiltered maps by the split sum: mean radiance incident on a lobe, times the lobe's
// reflectance under uniform illumination. Source: Karis 2013, "Real Shading in Unreal Engine 4". Exact for uniform
// illumination; docs/environment.md states the error elsewhere.
#pragma once
#if HAS_MIRRORS
#include "lib/environment/environment_map.glsl"
#endif
#include "lib/environment/filtered_map.glsl"
#include "lib/reflectance/even_light.glsl"
#include "lib/reflectance/mirrors.glsl"
#include "lib/reflectance/reflectance.glsl"

vec3 irradianceOn(vec3 normalLS)
{
    return filteredTexel(encodeOctahedral(mapDirection(normalLS)), ENVIRONMENT_IRRADIANCE_SIDE, ENVIRONMENT_LEVELS);
}

// Mean radiance incident on a lobe around its axis, interpolated between the two levels whose alphas enclose its alpha.
// Below the first level's alpha, blends towards the unfiltered map in the direction that mirrors the viewer.
vec3 filteredLight(vec3 axisLS, vec3 mirroredLS, float alpha)
{
    float level = filteredPlace(alpha);
    int fine = min(int(level), ENVIRONMENT_LEVELS - 2);
    precise float share = min(level - float(fine), 1.0);
    vec2 code = encodeOctahedral(mapDirection(axisLS));
    vec3 fineLight = filteredLevel(code, fine), coarseLight = filteredLevel(code, fine + 1);
    precise vec3 light = fineLight + share * (coarseLight - fineLight);
#if HAS_MIRRORS
    float sharp = mirrorShare(alpha);
    if (sharp > 0.0) {
        vec3 mirrored = mapRadiance(mapDirection(mirroredLS)).rgb;
        precise vec3 blended = light * (1.0 - sharp) + mirrored * sharp;
        return blended;
    }
#endif
    return light;
}

// Dominant direction of a lobe's light: the rougher, the nearer to the normal. Source: Lagarde and de Rousiers 2014,
// "Moving Frostbite to Physically Based Rendering", section 4.9.3.
vec3 lobeAxis(vec3 normal, vec3 mirrored, float alpha)
{
    precise float smoothness = clamp(1.0 - alpha, 0.0, 1.0);
    precise float share = smoothness * (sqrt(smoothness) + alpha);
    precise vec3 axis = normal + share * (mirrored - normal);
    return safeNormalize(axis, normal);
}

#if HAS_TANGENT_FRAME
const int kStretchedTaps = 16;

// A tap of an anisotropic lobe: xyz direction, w weight. Taps lie along the wider axis at equal fractions of the slope
// distribution of the microfacets, each as wide as the narrower alpha, or as the gap to the next tap if that is wider,
// so that a lamp does not show as a row of dots.
vec4 stretchedTap(SeenSurface seen, int tap, out float alpha)
{
    Surface surface = seen.surface;
    precise vec3 across = cross(surface.normalLS, surface.tangentLS);
    vec3 axis = surface.alpha >= surface.alphaBitangent ? surface.tangentLS : across;
    float wide = max(surface.alpha, surface.alphaBitangent), narrow = min(surface.alpha, surface.alphaBitangent);
    precise float share = (2.0 * float(tap) + 1.0) / float(kStretchedTaps) - 1.0;
    precise float slope = wide * share / sqrt(1.0 - share * share);
    precise vec3 leaning = surface.normalLS + slope * axis;
    vec3 mirrored = mirrorDirection(safeNormalize(leaning, surface.normalLS), seen.toViewer);
    precise float weight = max(dot(mirrored, surface.normalLS), 0.0);
    // D falls to half of its peak at a slope of 0.64 alpha.
    precise float gap = wide * (2.0 / float(kStretchedTaps)) / ((1.0 - share * share) * sqrt(1.0 - share * share));
    alpha = min(max(narrow, gap / 1.28), 1.0);
    return vec4(mirrored, weight);
}
#endif

// Mean radiance incident on the base lobe and on the coat's; black without such a lobe.
struct LobeLight {
    vec3 base, coat;
};

// A single loop over all look-ups, so that a program contains their code once.
LobeLight lightOfLobes(SeenSurface seen)
{
    int baseTaps = hasLobe(seen) ? 1 : 0, coatTaps = 0;
#if HAS_TANGENT_FRAME
    if (baseTaps > 0 && isAnisotropic(seen.surface)) baseTaps = kStretchedTaps;
#if HAS_MIRRORS
    if (isMirror(seen)) baseTaps = 1;
#endif
#endif
#if HAS_CLEARCOAT && !SPECULAR_OFF
    if (seen.surface.coatFactor > 0.0 && seen.coatNv > 0.0) coatTaps = 1;
#endif
    vec3 coat = vec3(0.0);
    precise vec3 sum = vec3(0.0);
    precise float weights = 0.0;
    for (int tap = 0; tap < baseTaps + coatTaps; ++tap) {
        vec3 normal = seen.surface.normalLS;
        float alpha = lobeAlpha(seen.surface);
#if HAS_CLEARCOAT
        if (tap >= baseTaps) {
            normal = seen.coatNormalLS;
            alpha = seen.surface.coatAlpha;
        }
#endif
        vec3 mirrored = mirrorDirection(normal, seen.toViewer);
        vec4 along = vec4(lobeAxis(normal, mirrored, alpha), 1.0);
#if HAS_TANGENT_FRAME
        if (baseTaps > 1 && tap < baseTaps) {
            along = stretchedTap(seen, tap, alpha);
            mirrored = along.xyz;
        }
#endif
        if (!(along.w > 0.0)) continue;
        vec3 light = filteredLight(along.xyz, mirrored, alpha);
        if (tap < baseTaps) {
            sum += along.w * light;
            weights += along.w;
        } else {
            coat = light;
        }
    }
    precise vec3 base = sum / max(weights, 1e-6);
    return LobeLight(base, coat);
}

// Irradiance that enters a surface, including wrapped light, as if both hemispheres had the mean of their irradiances.
vec3 enteringIrradiance(SeenSurface seen, vec3 irradiance)
{
    precise vec3 entering = irradiance;
#if HAS_SUBSURFACE_WRAP
    if (wrapsLight(seen.surface)) {
        vec3 wrap = subsurfaces[seen.surface.subsurface].wrap.rgb;
        entering += wrap * (0.5 * (irradiance + irradianceOn(-seen.surface.normalLS)));
    }
#endif
    return entering;
}

// Radiance towards the viewer from the environment.
vec3 environmentOnSurface(SeenSurface seen, vec2 pixel)
{
    LobeLight lobes = lightOfLobes(seen);
    EvenShares shares = evenShares(seen, true);
    vec3 irradiance = irradianceOn(seen.surface.normalLS);
    precise vec3 light = shares.ofEntering * enteringIrradiance(seen, irradiance) + shares.ofIrradiance * irradiance
                         + shares.ofLobe * lobes.base;
#if HAS_CLEARCOAT
    light += shares.ofCoat * lobes.coat;
#endif
    precise vec3 scaled = light * (environmentIntensity() * openShare(seen.surface));
    return scaled;
}
