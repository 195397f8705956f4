// Lighting for all techniques: the radiance that a surface reflects from one light, and the loop over lights. The light
// cursor (lib/light/light_cursor.glsl) selects the lights that a pixel visits.
#pragma once
#include "lib/reflectance/reflectance.glsl"
#include "lib/light/light.glsl"
#include "lib/light/light_cursor.glsl"
#include "lib/maths/cut_loop.glsl"
#ifndef AREA_SAMPLES
#define AREA_SAMPLES 0 // area lights, if any, use the closed form
#endif
#if HAS_AREA_LIGHTS
#if AREA_SAMPLES > 0
#include "lib/light/area_samples.glsl"
#else
#include "lib/light/area_light.glsl"
#endif
#endif
// Whether loops, with those nested in them, may exceed Mesa's iteration limit.
#define MAY_CUT_LOOPS (HAS_SHADOWS || AREA_SAMPLES > 0)
#if HAS_SHADOWS
#include "lib/shadow/shadow.glsl"
#endif
#if HAS_ENVIRONMENT
#include "shared/environment.h"
#if ENVIRONMENT_LIGHT == ENVIRONMENT_SAMPLED
#include "lib/environment/environment_samples.glsl"
#else
#include "lib/environment/environment_filtered.glsl"
#endif
#endif

// 1 if lights are counted instead of added (lib/lighting/views.glsl).
#ifndef VISIT_COUNTS
#define VISIT_COUNTS 0
#endif

// Whether lights affect the surface.
bool isLit(Surface surface)
{
    return !IS_UNLIT(surface.model);
}

// Prepares a surface for lighting; call before adding lights.
void prepareForLights(SeenSurface seen)
{
#if HAS_AREA_LIGHTS && AREA_SAMPLES == 0
    prepareAreaLobes(seen);
#endif
}

// Radiance towards the viewer from a light that reaches the surface, without shadows.
vec3 reflectedLight(int light, SeenSurface seen, Viewpoint viewpoint, Incident incident)
{
#if HAS_AREA_LIGHTS
    int kind = int(lightTexel(light, 1).w);
    if (IS_AREA_LIGHT(kind & LIGHT_TYPE_MASK))
        return areaLightOnSurface(light, kind, seen, viewpoint, incident.toLightLS, incident.irradiance);
#endif
    precise vec3 reflected = layeredBrdfCosine(seen, incident.toLightLS) * incident.irradiance;
    return reflected;
}

// Adds the shadowed radiance towards the viewer that a lit surface reflects from one light; or 1 if visits are counted.
// Every pass that adds light calls this function; only the debug views of D, G and F read a light directly. It adds
// instead of returning: a rasteriser that masks lanes would choose between the result and 0 before it adds (5 % of the
// time of 1,024 lights). Such rasterisers also run the code of shadows for all lights, so callers state whether any can
// be `shadowed`. IN_ATLAS also adds the part of the radiance transmitted through the surface's body to `passed`.
void addLightOnSurface(int light, const bool shadowed, SeenSurface seen, Viewpoint viewpoint, inout vec3 radiance,
                       inout vec3 passed)
{
#if VISIT_COUNTS
    radiance += vec3(1.0);
#else
    Incident incident;
    if (incidentLight(light, viewpoint.positionLS, incident)) {
        precise vec3 unshadowed = reflectedLight(light, seen, viewpoint, incident);
#if HAS_SHADOWS
        // Computes no shadow of black light: a shadow costs far more than the light.
        if (shadowed && unshadowed != vec3(0.0)) unshadowed *= shadowFactor(light, seen.surface, viewpoint);
#if HAS_SUBSURFACE_PASSAGE
        if (shadowed) {
            precise vec3 passing = passingBrdfCosine(seen, incident.toLightLS) * incident.irradiance;
            if (passing != vec3(0.0)) {
                passing *= passingShare(light, seen.surface, viewpoint);
                unshadowed += passing;
#if IN_ATLAS
                precise vec3 sumPassed = passed + passing;
                passed = sumPassed;
#endif
            }
        }
#endif
#endif
        precise vec3 sum = radiance + unshadowed;
        radiance = sum;
    }
#endif
}

#if HAS_SHADOWS
// Number of shadow-casting lights, which come first (renderer/frame/PackedLights.h).
int shadowedLights()
{
    return int(lighting.slices.y);
}
#endif

// Adds every light that the pixel's cursor visits, in ascending order; `passed` as in addLightOnSurface().
vec3 lightsOnSurface(vec3 before, SeenSurface seen, Viewpoint viewpoint, vec2 pixel, inout vec3 passed)
{
    precise vec3 radiance = before;
#if HAS_LIT_MODELS
    if (!isLit(seen.surface)) return radiance;
    prepareForLights(seen);
    LightCursor cursor = lightCursor(pixel, viewpoint.depth);
    int light;
    if (!nextLight(cursor, light) && !nextBatch(cursor, light)) return radiance;
    // Tests at the end: rasterisers that mask lanes instead of branching would run the body once more than there are
    // lights. LIGHTS_PER_ROUND (renderer/frame/LightRounds.h) is unrolled by hand: an inner loop would count towards
    // the same iteration limit.
#define ADD_LIGHT addLightOnSurface(light, false, seen, viewpoint, radiance, passed);
#define ADD_NEXT_LIGHT if (nextLight(cursor, light)) ADD_LIGHT
    bool more = true;
#if HAS_SHADOWS
    do {
        if (light >= shadowedLights()) break;
        addLightOnSurface(light, true, seen, viewpoint, radiance, passed);
        more = nextLight(cursor, light);
        if (!more) more = nextBatch(cursor, light);
    } while (more);
    if (more && light < shadowedLights()) return vec3(CUT_LOOP);
    if (!more) return radiance;
#endif
    do {
        do {
            ADD_LIGHT
#if LIGHTS_PER_ROUND > 1
            ADD_NEXT_LIGHT
#endif
#if LIGHTS_PER_ROUND > 2
            ADD_NEXT_LIGHT ADD_NEXT_LIGHT
#endif
#if LIGHTS_PER_ROUND > 4
            ADD_NEXT_LIGHT ADD_NEXT_LIGHT ADD_NEXT_LIGHT ADD_NEXT_LIGHT
#endif
            more = nextLight(cursor, light);
        } while (more);
#if MAY_CUT_LOOPS
        if (more) break; // the inner loop was truncated
#endif
        more = nextBatch(cursor, light);
    } while (more);
#if MAY_CUT_LOOPS
    // Shadow rays and samples count towards the iterations after which Mesa truncates loops
    // (lib/shadow/caster_walk.glsl).
    if (more) radiance = vec3(CUT_LOOP);
#endif
#endif
    return radiance;
}

// Radiance of the surface towards the viewer: its emission, the environment and its lights; `passed` as in
// addLightOnSurface().
vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel, inout vec3 passed)
{
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    precise vec3 radiance = emittedRadiance(seen);
#if HAS_ENVIRONMENT
    if (isLit(surface)) radiance += environmentOnSurface(seen, pixel);
#endif
    return lightsOnSurface(radiance, seen, viewpoint, pixel, passed);
}

vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    vec3 passed = vec3(0.0);
    return shadeSurface(surface, viewpoint, pixel, passed);
}
