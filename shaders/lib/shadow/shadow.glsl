// Shadows: how much of a light reaches a point past the casters (scenes/Shadows.h). Every technique, transparent
// surfaces and light volumes ask shadowFactor() and nothing else.
#pragma once
#include "lib/light/light_store.glsl"
#if HAS_SHADOW_MAPS
#include "lib/shadow/shadow_map.glsl"
#else
#include "lib/shadow/traced_shadow.glsl"
#endif

// The share of light `index` that casters let through to a point of a surface: 0 where they hide all of it, 1 where they
// hide nothing or the light casts no shadows. A surface hides lights behind its triangle, whatever normal it is lit with.
float shadowFactor(int index, Surface surface, Viewpoint viewpoint)
{
    int kind = int(lightTexel(index, 1).w);
    if ((kind & LIGHT_SHADOWED) == 0) return 1.0;
#if HAS_DIRECTIONAL_LIGHTS
    bool isFar = (kind & LIGHT_TYPE_MASK) == LIGHT_DIRECTIONAL;
#else
    bool isFar = false;
#endif
#if HAS_SHADOW_MAPS
    return mappedShadow(index, kind, lightTexel(index, 0).xyz, isFar, surface.facetNormalLS, viewpoint);
#else
    return tracedShadow(index, lightTexel(index, 0).xyz, isFar, surface.facetNormalLS, viewpoint);
#endif
}
