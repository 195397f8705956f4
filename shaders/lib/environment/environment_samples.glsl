// Environment lighting by Monte Carlo sampling per pixel: of the map's radiance, the cosine, the lobe and the coat.
// Each sample is weighted by the densities of all of them in its direction (multiple importance sampling), so that none
// is needed for the others to converge. Source: Veach and Guibas 1995, "Optimally Combining Sampling Techniques for
// Monte Carlo Rendering", the balance heuristic.
#pragma once
#include "lib/environment/environment_map.glsl"
#if ENVIRONMENT_COMPENSATION
#include "lib/reflectance/lobes.glsl"
#endif
#include "lib/reflectance/lobe_samples.glsl"
#include "lib/reflectance/mirrors.glsl"
#include "lib/maths/random.glsl"

layout(binding = TEXTURE_UNIT_ENVIRONMENT_SAMPLES) uniform samplerBuffer environmentSamples;

// Point k of a low-discrepancy sequence in the unit square, from any start. Source: Roberts 2018, "The Unreasonable
// Effectiveness of Quasirandom Sequences": fractions of the plastic number.
vec2 evenPoint(uvec2 start, int k)
{
    return unitOf(start + uint(k) * uvec2(3242174889u, 2447445414u));
}

// lostToBounces() as a BRDF, attenuated by the layers above.
vec3 bouncesBelowLayers(SeenSurface seen)
{
#if ENVIRONMENT_COMPENSATION && HAS_GGX_MODELS
    precise vec3 bounces = lostToBounces(seen) * kInversePi;
#if HAS_SHEEN
    bounces *= viewerShareUnderSheen(seen);
#endif
#if HAS_CLEARCOAT
    bounces *= 1.0 - seen.coatWeight;
#endif
    return bounces;
#else
    return vec3(0.0);
#endif
}

// Contribution of a sample in a direction; callers divide by the number of samples of each kind.
vec3 sampledLight(SeenSurface seen, vec3 bounces, vec3 toLight, vec3 radiance, float mapDensity)
{
    precise vec3 brdfCosine = layeredBrdfCosine(seen, toLight);
#if ENVIRONMENT_COMPENSATION
    brdfCosine += bounces * max(dot(seen.surface.normalLS, toLight), 0.0);
#endif
    if (brdfCosine == vec3(0.0) || radiance == vec3(0.0)) return vec3(0.0);
    precise float density = mapDensity + surfaceDensity(seen, toLight);
    precise vec3 light = brdfCosine * (radiance / density);
    return light;
}

vec3 sampledDirection(SeenSurface seen, vec3 bounces, vec3 toLight)
{
    if (toLight == vec3(0.0)) return vec3(0.0); // no direction was found
    vec4 found = mapRadiance(mapDirection(toLight));
    return sampledLight(seen, bounces, toLight, found.rgb, found.a);
}

#if HAS_MIRRORS
// Radiance towards the viewer from mirror lobes, without the map's intensity. No sample would hit their direction, so
// this removes them from the lobes to be sampled.
vec3 takeMirrors(inout SeenSurface seen)
{
    precise vec3 light = vec3(0.0);
#if HAS_GGX_MODELS
    if (isMirror(seen)) {
        precise vec3 reflected = mirrorReflectance(seen);
#if HAS_SHEEN
        if (HAS_METALLIC(seen.surface.model)) reflected *= viewerShareUnderSheen(seen);
#endif
#if HAS_CLEARCOAT
        reflected *= 1.0 - seen.coatWeight;
#endif
        light = reflected * mapRadiance(mapDirection(mirrorDirection(seen.surface.normalLS, seen.toViewer))).rgb;
        seen.scale = 0.0; // factor of the distribution of normals
        if (IS_MICROFACET(seen.surface.model)) seen.surface.model = MODEL_LAMBERT; // their diffuse part
    }
#endif
#if HAS_CLEARCOAT && !SPECULAR_OFF
    if (seen.surface.coatFactor > 0.0 && seen.coatNv > 0.0 && seen.surface.coatAlpha <= ALPHA_MIN) {
        light += seen.coatWeight * mapRadiance(mapDirection(mirrorDirection(seen.coatNormalLS, seen.toViewer))).rgb;
        seen.coatNv = 0.0; // no coat lobe, as if seen edge-on
    }
#endif
    return light;
}
#endif

// Radiance towards the viewer from the environment.
vec3 environmentOnSurface(SeenSurface seen, vec2 pixel)
{
    bool samplesLobe = hasLobe(seen);
#if HAS_MIRRORS
    samplesLobe = samplesLobe && !isMirror(seen);
    vec3 mirrored = takeMirrors(seen);
#endif
    uvec3 random = hashOf(uvec3(uvec2(pixel), 0x9e3779b9u));
    const int kRuns = (1 << ENVIRONMENT_SAMPLES_LOG2) / ENVIRONMENT_SAMPLES;
    int first = int(random.z % uint(kRuns)) * ENVIRONMENT_SAMPLES;
    vec3 normal = seen.surface.normalLS;
    vec3 tangent = sampledTangent(seen);
    vec3 bounces = bouncesBelowLayers(seen);
    precise vec3 sum = vec3(0.0);
    for (int k = 0; k < ENVIRONMENT_SAMPLES; ++k) {
        vec4 ofMap = texelFetch(environmentSamples, (first + k) * ENVIRONMENT_SAMPLE_TEXELS);
        vec4 light = texelFetch(environmentSamples, (first + k) * ENVIRONMENT_SAMPLE_TEXELS + 1);
        if (ofMap.w > 0.0) sum += sampledLight(seen, bounces, fromMapDirection(ofMap.xyz), light.rgb, ofMap.w);
        vec2 point = evenPoint(random.xy, k);
        sum += sampledDirection(seen, bounces, cosineDirection(point, normal, tangent));
        if (samplesLobe) sum += sampledDirection(seen, bounces, lobeDirection(point, seen, tangent));
#if HAS_CLEARCOAT && !SPECULAR_OFF
        if (seen.surface.coatFactor > 0.0 && seen.coatNv > 0.0)
            sum += sampledDirection(seen, bounces, coatDirection(point, seen));
#endif
    }
    precise float scale = environmentIntensity() * openShare(seen.surface);
    precise vec3 mean = sum * (scale / float(ENVIRONMENT_SAMPLES));
#if HAS_MIRRORS
    mean += mirrored * scale;
#endif
    return mean;
}
