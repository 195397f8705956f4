// Samples of a light's surface for soft shadows (scenes/Shadows.h), in metres from its centre in world axes.
#pragma once
#include "lib/light/area_places.glsl"
#include "lib/light/light_store.glsl"
#include "lib/shadow/disk_samples.glsl"

// Axes of a light's surface. Disk: perpendicular radii that face the point; flat area light: its axes; tube: radii of
// its disks, and half of its axis.
struct ShadowSurface {
    int light, type;
    vec3 right, up, axis;
};

ShadowSurface shadowSurface(int light, bool isArea, float radius, vec3 right, vec3 up)
{
    precise vec3 diskRight = radius * right, diskUp = radius * up;
    ShadowSurface surface = ShadowSurface(light, -1, diskRight, diskUp, vec3(0.0));
#if HAS_AREA_LIGHTS
    if (isArea) {
        surface.type = int(lightTexel(light, 1).w) & LIGHT_TYPE_MASK;
        vec4 first = lightShapeTexel(light, 0), second = lightShapeTexel(light, 1);
        precise vec3 along = mat3(view.worldFromLS) * first.xyz;
        precise vec3 across = mat3(view.worldFromLS) * second.xyz;
        if (surface.type == LIGHT_TUBE) {
            precise vec3 tubeRight = first.w * right, tubeUp = first.w * up;
            surface.right = tubeRight;
            surface.up = tubeUp;
            surface.axis = along;
        } else if (surface.type != LIGHT_SPHERE) {
            surface.right = along;
            surface.up = across;
        }
    }
#endif
    return surface;
}

#if HAS_AREA_LIGHTS
// Sample i of SHADOW_SAMPLES in the unit square: one per column, with rows spaced by the golden ratio, all shifted by
// the same random numbers.
vec2 squarePlace(int i, vec2 random)
{
    precise float column = (float(i) + random.y) * (1.0 / float(SHADOW_SAMPLES));
    precise float row = fract(random.x + 0.61803399 * float(i));
    return vec2(min(column, 0.99999994), row);
}
#endif

// Sample i of SHADOW_SAMPLES. Source of the step along a tube: Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences".
vec3 surfacePlace(ShadowSurface surface, int i, vec2 random, float third)
{
    vec2 place;
    float along = 0.0;
#if HAS_AREA_LIGHTS
    if (surface.type == LIGHT_RECTANGLE) {
        precise vec2 inSquare = 2.0 * squarePlace(i, random) - 1.0;
        place = inSquare;
    } else
#endif
#if HAS_POLYGON_LIGHTS
    if (surface.type == LIGHT_POLYGON) {
        place = polygonPlace(surface.light, squarePlace(i, random));
    } else
#endif
    {
        place = diskPlace(i, random);
    }
#if HAS_TUBE_LIGHTS
    if (surface.type == LIGHT_TUBE) {
        precise float onAxis = 2.0 * fract(third + 0.75487767 * float(i)) - 1.0;
        along = onAxis;
    }
#endif
    precise vec3 metres = place.x * surface.right + place.y * surface.up + along * surface.axis;
    return metres;
}
