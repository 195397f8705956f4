// Shadows: the fraction of a light that casters let through to a point (scenes/Shadows.h). Every technique, transparent
// surfaces and light volumes call shadowFactor() and nothing else.
#pragma once
#include "lib/light/light_store.glsl"
#include "lib/reflectance/subsurface.glsl"
#if HAS_SHADOW_LIFT
#include "lib/shadow/shadow_lift.glsl"
#endif
#if HAS_SHADOW_MAPS
#include "lib/shadow/shadow_map.glsl"
#else
#include "lib/shadow/traced_shadow.glsl"
#endif

// Fraction of light `index` that casters let through to a point of a surface: 0 if they hide all of it, 1 if they hide
// nothing or the light casts no shadows. A surface hides lights behind its triangle, whatever its shading normal,
// unless it wraps light. On a smooth-shaded surface the look-up starts above the triangle, which then hides light like
// any other, and lights behind the plane of the shading normal are hidden.
float shadowFactor(int index, Surface surface, Viewpoint viewpoint)
{
    int kind = int(lightTexel(index, 1).w);
    if ((kind & LIGHT_SHADOWED) == 0) return 1.0;
#if HAS_DIRECTIONAL_LIGHTS
    bool isFar = (kind & LIGHT_TYPE_MASK) == LIGHT_DIRECTIONAL;
#else
    bool isFar = false;
#endif
#if HAS_AREA_LIGHTS
    bool isCut = IS_AREA_LIGHT(kind & LIGHT_TYPE_MASK);
#else
    bool isCut = false;
#endif
    vec3 placeLS = lightTexel(index, 0).xyz;
    OwnPlane own = OwnPlane(surface.facetNormalLS, FACET_ERROR_RADIANS, true);
    vec3 planeNormalLS = surface.facetNormalLS;
#if HAS_SHADOW_LIFT
    float lift = decodeLift(surface.liftCode, viewpoint.positionLS);
#if HAS_SUBSURFACE_WRAP
    if (wrapsLight(surface)) lift = 0.0;
#endif
#if !HAS_SHADOW_MAPS
    // A triangle that is nearer counts as the point's own, and hides nothing (lib/shadow/caster_walk.glsl).
    if (lift * casterTree.rwsOriginCS.w < 2.0 * roundingAt(viewpoint.positionLS)) lift = 0.0;
#endif
    if (lift > 0.0) {
        precise vec3 liftedLS = viewpoint.positionLS - lift * surface.facetNormalLS;
        viewpoint.positionLS = liftedLS;
        own.normal = -surface.normalLS;
        own.errorRadians = 0.0;
#if HAS_SHADOW_MAPS
        precise vec3 toLight = isFar ? placeLS : placeLS - liftedLS;
        planeNormalLS = liftedPlaneNormal(surface.facetNormalLS, toLight);
#endif
    }
#endif
#if HAS_SUBSURFACE_WRAP
    if (wrapsLight(surface)) {
        precise vec3 toLight = isFar ? placeLS : placeLS - viewpoint.positionLS;
        precise float cosine = dot(surface.normalLS, toLight) / sqrt(max(dot(toLight, toLight), 1e-37));
        precise vec3 liftedLS = viewpoint.positionLS + surface.normalLS * liftMetres(surface, cosine);
        viewpoint.positionLS = liftedLS;
        own.hides = false;
    }
#endif
#if HAS_SHADOW_MAPS
    return mappedShadow(index, kind, placeLS, isFar, planeNormalLS, own, viewpoint);
#else
    return tracedShadow(index, placeLS, isFar, isCut, own, viewpoint);
#endif
}

#if HAS_SUBSURFACE_PASSAGE
// Fraction of light `index`, by channel, that is transmitted to a point of a surface through bodies of the surface's
// material (docs/skin.md). Traced: other casters hide it. Maps: the way is the distance of the point behind the first
// caster. A light with a size counts as its centre. Lights that cast no shadows are not transmitted.
vec3 passingShare(int index, Surface surface, Viewpoint viewpoint)
{
    int kind = int(lightTexel(index, 1).w);
    if ((kind & LIGHT_SHADOWED) == 0) return vec3(0.0);
#if HAS_DIRECTIONAL_LIGHTS
    bool isFar = (kind & LIGHT_TYPE_MASK) == LIGHT_DIRECTIONAL;
#else
    bool isFar = false;
#endif
    vec3 placeLS = lightTexel(index, 0).xyz;
#if HAS_SHADOW_MAPS
    float metres = mappedPassage(index, kind, placeLS, isFar, surface.facetNormalLS, viewpoint);
#else
    float metres = tracedPassage(placeLS, isFar, surface.subsurface, viewpoint);
#endif
    return metres < 0.0 ? vec3(0.0) : isnan(metres) ? vec3(CUT_LOOP) : shareAfter(surface, metres);
}
#endif
