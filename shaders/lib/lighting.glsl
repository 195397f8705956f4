// Lighting, once for all techniques: one light on one surface, and the loop over lights. Which lights a pixel visits is the
// light cursor's business (lib/light_cursor.glsl).
#pragma once
#include "lib/brdf.glsl"
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/light_cursor.glsl"

// 1 where lights are counted instead of added (lib/views.glsl).
#ifndef VISIT_COUNTS
#define VISIT_COUNTS 0
#endif

// The factors of the specular lobe, kept apart for the views that show them.
struct SpecularTerms {
    float d;  // distribution of normals, 1/sr
    float v;  // G / (4 n.l n.v)
    vec3 f;   // Fresnel reflectance
};

// d and v are 0 where the lobe is: l or v below the horizon, or l = -v. The Fresnel factor needs only the angle between l and h and
// goes on to its grazing value where l = -v, so that the diffuse share 1 - F stays continuous.
SpecularTerms specularTerms(Surface surface, vec3 toLight, vec3 toViewer, float nl)
{
    SpecularTerms terms = SpecularTerms(0.0, 0.0, vec3(0.0));
    precise vec3 sum = toLight + toViewer;
    precise float length2 = dot(sum, sum);
    precise vec3 h = length2 > 0.0 ? sum / sqrt(length2) : vec3(0.0);
    precise float lh = dot(toLight, h);
    precise float nv = dot(surface.normalLS, toViewer);
    bool glossy = nl > 0.0 && nv > 0.0 && length2 > 0.0;
    if (glossy) terms.d = distributionGgx(surface.alpha, surface.normalLS, h);
#if HAS_METALLIC_ROUGHNESS
    if (surface.model == MODEL_METALLIC_ROUGHNESS) {
        precise vec3 f0 = surface.specular + (surface.albedo - surface.specular) * surface.metallic;
        precise float f90 = surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic;
        terms.f = fresnelSchlick(f0, f90, lh);
        if (glossy) terms.v = visibilityCorrelated(surface.alpha, nl, nv);
    }
#endif
#if HAS_MICROFACET
    if (surface.model == MODEL_MICROFACET) {
        terms.f = vec3(fresnelDielectric(surface.iorOrF90, lh));
        if (glossy) terms.v = visibilitySeparable(surface.alpha, nl, nv);
    }
#endif
    return terms;
}

// Radiance towards the viewer for one unit of incident intensity: the model's BRDF times max(0, n.l).
vec3 reflectedShare(Surface surface, vec3 toLight, vec3 toViewer)
{
    precise float nl = dot(surface.normalLS, toLight);
    if (!(nl > 0.0)) return vec3(0.0);
    precise vec3 share = surface.albedo; // k_d of the teaching models, which carry no 1/pi
#if HAS_METALLIC_ROUGHNESS || HAS_MICROFACET
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
    }
#endif
#if HAS_MICROFACET
    if (surface.model == MODEL_MICROFACET) share = surface.albedo + surface.specular * (terms.f * dv);
#endif
#endif
    precise vec3 reflected = share * nl;
    return reflected;
}

// Whether any light changes the surface.
bool takesLight(Surface surface)
{
#if HAS_SINGLE_COLOR
    return surface.model != MODEL_SINGLE_COLOR;
#else
    return true;
#endif
}

// Adds the radiance towards the viewer that one light gives to a surface that takes light; where visits are counted, 1.
void addLightOnSurface(int light, Surface surface, Viewpoint viewpoint, inout vec3 radiance)
{
#if VISIT_COUNTS
    radiance += vec3(1.0);
#else
    Incident incident;
    if (incidentLight(light, viewpoint.positionLS, incident)) {
        precise vec3 reflected = reflectedShare(surface, incident.toLightLS, viewpoint.toViewerLS);
        precise vec3 sum = radiance + reflected * incident.intensity;
        radiance = sum;
    }
#endif
}

// Adds every light that the surface's cursor visits, in ascending order.
vec3 lightsOnSurface(vec3 before, Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    precise vec3 radiance = before;
#if HAS_LIT_MODELS
    if (!takesLight(surface)) return radiance;
    LightCursor cursor = lightCursor(pixel, viewpoint.depth);
    int light;
    if (!nextLight(cursor, light) && !nextBatch(cursor, light)) return radiance;
    // Tested at the end: rasterisers that mask lanes instead of branching would run a loop's body once more than its lights.
    do {
        do {
            addLightOnSurface(light, surface, viewpoint, radiance);
#if LIGHTS_PER_ROUND == 2
            if (nextLight(cursor, light)) addLightOnSurface(light, surface, viewpoint, radiance);
#endif
        } while (nextLight(cursor, light));
    } while (nextBatch(cursor, light));
#endif
    return radiance;
}

// Radiance of the surface towards the viewer: its emission and its lights.
vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    return lightsOnSurface(surface.emission, surface, viewpoint, pixel);
}
