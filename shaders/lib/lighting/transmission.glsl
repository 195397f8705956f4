// Light that passes through a surface towards the viewer (docs/glass.md). Source: KHR_materials_transmission, _volume and
// _dispersion.
#pragma once
#include "lib/lighting/lighting.glsl"
#if HAS_ENVIRONMENT && ENVIRONMENT_LIGHT == ENVIRONMENT_SAMPLED
#include "lib/maths/random.glsl"
#endif

// By channel, of a radiance from behind: what the surface and its layers do not reflect, tinted.
vec3 passedShare(SeenSurface seen)
{
    // Where the shading normal points away from the viewer nothing is reflected, so that all of it passes.
    precise vec3 reflected = vec3(0.0);
    if (seen.nv > 0.0) reflected = fresnelSchlick(seen.f0, seen.fresnelRise, min(seen.nv, 1.0));
    precise vec3 share = seen.surface.passing * max(vec3(1.0) - reflected, vec3(0.0));
#if HAS_SHEEN
    if (strongestSheen(seen.surface) > 0.0) share *= viewerShareUnderSheen(seen);
#endif
#if HAS_CLEARCOAT
    if (seen.surface.coatFactor > 0.0) share *= 1.0 - seen.coatWeight;
#endif
    return share;
}

#if HAS_ENVIRONMENT && HAS_VOLUME
// Along which the light came that leaves towards the viewer, bent once, by Snell's law; 0 where the surface lets none
// out. An index of 0 is one without bound, which bends all light onto the normal. Source: KHR_materials_ior; GLSL 4.50,
// refract(), which does not say how it rounds.
vec3 refractedDirection(vec3 normal, vec3 toViewer, float ior)
{
    precise float along = dot(normal, toViewer);
    vec3 outward = along < 0.0 ? -normal : normal;
    precise float cosine = min(abs(along), 1.0);
    precise float inverse = ior > 0.0 ? 1.0 / ior : 0.0;
    precise float cosine2 = 1.0 - inverse * inverse * (1.0 - cosine * cosine);
    if (!(cosine2 >= 0.0)) return vec3(0.0);
    precise vec3 direction = (inverse * cosine - sqrt(cosine2)) * outward - inverse * toViewer;
    return safeNormalize(direction, -outward);
}

#if HAS_DISPERSION
// The index of refraction of red, green and blue: that of the material is green's, and none falls below 1 from above it.
// An index of 0, which has no bound, has no spread. Source: KHR_materials_dispersion.
vec3 iorByChannel(float ior)
{
    precise float spread = max(ior - 1.0, 0.0) * material.attenuation.a;
    precise float red = max(ior - spread, min(ior, 1.0));
    precise float blue = ior + spread;
    return vec3(red, ior, blue);
}
#endif

// The environment around a direction, as its filtered map averages it: by a GGX lobe seen from its own axis, weighted by
// the cosine.
vec3 surroundingsAlong(vec3 direction, float alpha, vec2 pixel)
{
#if ENVIRONMENT_LIGHT == ENVIRONMENT_SAMPLED
    if (alpha <= ALPHA_MIN) return mapRadiance(mapDirection(direction)).rgb;
    uvec3 random = hashOf(uvec3(uvec2(pixel), 0x85ebca6bu));
    vec3 tangent = anyPerpendicular(direction);
    precise vec3 sum = vec3(0.0);
    precise float weights = 0.0;
    for (int k = 0; k < ENVIRONMENT_SAMPLES; ++k) {
        vec3 toLight = visibleReflection(evenPoint(random.xy, k), vec2(alpha), direction, direction, tangent);
        precise float weight = max(dot(toLight, direction), 0.0);
        sum += weight * mapRadiance(mapDirection(toLight)).rgb;
        weights += weight;
    }
    precise vec3 mean = sum / max(weights, 1e-6);
    return mean;
#else
    return filteredLight(direction, direction, alpha);
#endif
}
#endif

#if HAS_ENVIRONMENT && HAS_VOLUME
// The environment that a body shows; black in channels of which it lets nothing out.
vec3 surroundingsThrough(Surface surface, vec3 toViewerLS, vec2 pixel)
{
    vec3 light = vec3(0.0);
#if HAS_DISPERSION
    if (material.attenuation.a > 0.0) {
        vec3 iors = iorByChannel(surface.passingIor);
        for (int c = 0; c < 3; ++c) {
            vec3 bent = refractedDirection(surface.normalLS, toViewerLS, iors[c]);
            if (bent != vec3(0.0)) light[c] = surroundingsAlong(bent, surface.passingAlpha, pixel)[c];
        }
        return light;
    }
#endif
    vec3 direction = refractedDirection(surface.normalLS, toViewerLS, surface.passingIor);
    if (direction != vec3(0.0)) light = surroundingsAlong(direction, surface.passingAlpha, pixel);
    return light;
}
#endif

// What comes through a surface: radiance of its own, and what it keeps of the radiance behind it, by channel.
struct ThroughSurface {
    vec3 radiance;
    vec3 kept;
};

ThroughSurface lightThrough(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    ThroughSurface through = ThroughSurface(vec3(0.0), passedShare(seen));
#if HAS_ENVIRONMENT && HAS_VOLUME
    if (material.transmission.z > 0.0) {
        vec3 light = surroundingsThrough(surface, viewpoint.toViewerLS, pixel);
        precise vec3 radiance = through.kept * light * environment.light.x;
        through.radiance = radiance;
        through.kept = vec3(0.0);
    }
#endif
    return through;
}
