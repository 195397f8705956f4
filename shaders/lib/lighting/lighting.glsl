// Lighting, once for all techniques: the radiance that a surface reflects of one light, and the loop over lights. The
// light cursor (lib/light/light_cursor.glsl) chooses the lights that a pixel visits.
#pragma once
#include "lib/reflectance/reflectance.glsl"
#include "lib/light/light.glsl"
#include "lib/light/light_cursor.glsl"
#include "lib/maths/cut_loop.glsl"
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

#if HAS_SHADOWS && HAS_SUBSURFACE_DEPTH_MAP && IN_ATLAS
vec3 passedLight = vec3(0.0); // of it, what the lights added so far send through the surface's body
#endif

// Adds the radiance towards the viewer that a lit surface reflects of one light; where visits are counted, 1. Every
// pass that adds light calls this function; only the debug views of D, G and F read a light directly. Shadows are asked
// for here, and area lights belong here, not in a loop; data of the surface that they need besides the shading normal
// become members of Surface. It adds instead of returning: a rasteriser that masks lanes would choose between the
// result and 0 before it adds (5 % of the time of 1,024 lights). It also runs the code of shadows for all lights, so
// callers say where none can be `shadowed`.
void addLightOnSurface(int light, const bool shadowed, SeenSurface seen, Viewpoint viewpoint, inout vec3 radiance)
{
#if VISIT_COUNTS
    radiance += vec3(1.0);
#else
    Incident incident;
    if (incidentLight(light, viewpoint.positionLS, incident)) {
        vec3 brdfCosine = layeredBrdfCosine(seen, incident.toLightLS);
#if HAS_SHADOWS
        precise vec3 unshadowed = brdfCosine * incident.irradiance;
        // A shadow costs far more than what it would hide.
        if (shadowed && unshadowed != vec3(0.0)) unshadowed *= shadowFactor(light, seen.surface, viewpoint);
#if HAS_SUBSURFACE_DEPTH_MAP
        if (shadowed) {
            precise vec3 passing = passingBrdfCosine(seen, incident.toLightLS) * incident.irradiance;
            if (passing != vec3(0.0)) {
                passing *= passingShare(light, seen.surface, viewpoint);
                unshadowed += passing;
#if IN_ATLAS
                precise vec3 passed = passedLight + passing;
                passedLight = passed;
#endif
            }
        }
#endif
        precise vec3 sum = radiance + unshadowed;
#else
        precise vec3 sum = radiance + brdfCosine * incident.irradiance;
#endif
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

// Adds every light that the surface's cursor visits, in ascending order.
vec3 lightsOnSurface(vec3 before, SeenSurface seen, Viewpoint viewpoint, vec2 pixel)
{
    precise vec3 radiance = before;
#if HAS_LIT_MODELS
    if (!takesLight(seen.surface)) return radiance;
    LightCursor cursor = lightCursor(pixel, viewpoint.depth);
    int light;
    if (!nextLight(cursor, light) && !nextBatch(cursor, light)) return radiance;
    // Tested at the end: rasterisers that mask lanes instead of branching would run a loop's body once more than its
    // lights. LIGHTS_PER_ROUND (renderer/frame/LightRounds.h) is spelt out: an inner loop would count towards the same
    // limit.
#define ADD_LIGHT addLightOnSurface(light, false, seen, viewpoint, radiance);
#define ADD_NEXT_LIGHT if (nextLight(cursor, light)) ADD_LIGHT
    bool more = true;
#if HAS_SHADOWS
    do {
        if (light >= shadowedLights()) break;
        addLightOnSurface(light, true, seen, viewpoint, radiance);
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
#if HAS_SHADOWS
        if (more) break; // the inner loop was ended
#endif
        more = nextBatch(cursor, light);
    } while (more);
#if HAS_SHADOWS
    // Walks through casters count towards the iterations after which Mesa ends loops (lib/shadow/caster_walk.glsl).
    if (more) radiance = vec3(CUT_LOOP);
#endif
#endif
    return radiance;
}

// Radiance of the surface towards the viewer: its emission, the environment and its lights.
vec3 shadeSurface(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    precise vec3 radiance = emittedRadiance(seen);
#if HAS_ENVIRONMENT
    if (takesLight(surface)) radiance += environmentOnSurface(seen, pixel);
#endif
    return lightsOnSurface(radiance, seen, viewpoint, pixel);
}
