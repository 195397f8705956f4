// Lighting, once for all techniques: the radiance that a surface reflects of one light, and the loop over lights. The
// light cursor (lib/light/light_cursor.glsl) chooses the lights that a pixel visits.
#pragma once
#include "lib/reflectance/reflectance.glsl"
#include "lib/light/light.glsl"
#include "lib/light/light_cursor.glsl"
#include "lib/maths/cut_loop.glsl"
#ifndef AREA_SAMPLES
#define AREA_SAMPLES 0 // area lights are found in closed form, or there are none
#endif
#if HAS_AREA_LIGHTS
#if AREA_SAMPLES > 0
#include "lib/light/area_samples.glsl"
#else
#include "lib/light/area_light.glsl"
#endif
#endif
// Whether loops may take more iterations than Mesa lets them make, together with those that are nested in them.
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

// 1 where lights are counted instead of added (lib/lighting/views.glsl).
#ifndef VISIT_COUNTS
#define VISIT_COUNTS 0
#endif

// Whether any light changes the surface.
bool takesLight(Surface surface)
{
    return !IS_UNLIT(surface.model);
}

// To be called with a surface before lights are added on it.
void prepareForLights(SeenSurface seen)
{
#if HAS_AREA_LIGHTS && AREA_SAMPLES == 0
    prepareAreaLobes(seen);
#endif
}

// Radiance towards the viewer that the surface reflects of a light that reaches it, without shadows.
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

// Adds the radiance towards the viewer that a lit surface reflects of one light; where visits are counted, 1. Every
// pass that adds light calls this function; only the debug views of D, G and F read a light directly. Shadows are asked
// for here. It adds instead of returning: a rasteriser that masks lanes would choose between the result and 0 before it
// adds (5 % of the time of 1,024 lights). It also runs the code of shadows for all lights, so callers say where none
// can be `shadowed`. What of the radiance has passed through the surface's body is added to `passed` too, where
// IN_ATLAS.
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
        // A shadow costs far more than what it would hide.
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
// Lights that casters may hide come first (renderer/frame/PackedLights.h): so many.
int shadowedLights()
{
    return int(lighting.slices.y);
}
#endif

// Adds every light that the surface's cursor visits, in ascending order; `passed` as addLightOnSurface() has it.
vec3 lightsOnSurface(vec3 before, SeenSurface seen, Viewpoint viewpoint, vec2 pixel, inout vec3 passed)
{
    precise vec3 radiance = before;
#if HAS_LIT_MODELS
    if (!takesLight(seen.surface)) return radiance;
    prepareForLights(seen);
    LightCursor cursor = lightCursor(pixel, viewpoint.depth);
    int light;
    if (!nextLight(cursor, light) && !nextBatch(cursor, light)) return radiance;
    // Tested at the end: rasterisers that mask lanes instead of branching would run a loop's body once more than its
    // lights. LIGHTS_PER_ROUND (renderer/frame/LightRounds.h) is spelt out: an inner loop would count towards the same
    // limit.
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
        if (more) break; // the inner loop was ended
#endif
        more = nextBatch(cursor, light);
    } while (more);
#if MAY_CUT_LOOPS
    // Walks through casters and samples count towards the iterations after which Mesa ends loops (lib/shadow/caster_walk.glsl).
    if (more) radiance = vec3(CUT_LOOP);
#endif
#endif
    return radiance;
}

// Radiance of the surface towards the viewer: its emission, the environment and its lights; `passed` as
// addLightOnSurface() has it.
vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel, inout vec3 passed)
{
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    precise vec3 radiance = emittedRadiance(seen);
#if HAS_ENVIRONMENT
    if (takesLight(surface)) radiance += environmentOnSurface(seen, pixel);
#endif
    return lightsOnSurface(radiance, seen, viewpoint, pixel, passed);
}

vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    vec3 passed = vec3(0.0);
    return shadeSurface(surface, viewpoint, pixel, passed);
}
