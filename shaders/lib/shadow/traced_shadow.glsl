// Shadows by rays from a point to the light, or to samples of its surface.
#pragma once
#include "lib/light/light_store.glsl"
#include "lib/shadow/caster_walk.glsl"
#include "lib/shadow/own_triangle.glsl"

#if HAS_SOFT_SHADOWS
#include "lib/shadow/surface_samples.glsl"
#endif

// 0 if a caster hides that point of the light, else 1. `behind` grows by 1 if the point's own plane does.
float visibilityOf(vec3 toPlaceCS, float placeRounding, OwnPlane own, vec3 originLS, inout float behind)
{
    ShadowRay ray = shadowRay(originLS, toPlaceCS, placeRounding);
    bool isBehind = hidesBehind(own, toPlaceCS, ray.originRounding + placeRounding);
    behind += isBehind ? 1.0 : 0.0;
    return visibilityAlong(ray, isBehind);
}

#if HAS_SUBSURFACE_PASSAGE
// Metres that the way to a light lies inside bodies whose row of SubsurfaceConstants is `subsurface`; below 0 if
// something else hides the light. Arguments as of tracedShadow().
float tracedPassage(vec3 placeLS, bool isFar, uint subsurface, Viewpoint viewpoint)
{
    precise vec3 fromPoint = isFar ? placeLS : placeLS - viewpoint.positionLS;
    precise vec3 toLight = mat3(view.worldFromLS) * fromPoint;
    precise float farAway = 2.0 * (casterTree.rounding.z + length(positionCS(viewpoint.positionLS)));
    precise vec3 toPlace = (isFar ? farAway : casterTree.rwsOriginCS.w) * toLight;
    ShadowRay ray = shadowRay(viewpoint.positionLS, toPlace, isFar ? 0.0 : roundingAt(placeLS));
    float share = passageAlong(ray, subsurface);
    precise float metres = max(share, 0.0) * length(toPlace) / casterTree.rwsOriginCS.w;
    return share == PASSAGE_HIDDEN ? -1.0 : isnan(share) ? CUT_LOOP : metres;
}
#endif

// Fraction of light `index` that casters let through, at the position placeLS or (isFar) in that direction, where rays
// end behind all casters. Computed in world axes, whose numbers do not depend on those of lighting space. If the light
// is clipped at the horizon (isCut), it is the fraction of the part in front of the point's own plane.
float tracedShadow(int index, vec3 placeLS, bool isFar, bool isCut, OwnPlane ownLS, Viewpoint viewpoint)
{
    precise vec3 ownNormal = mat3(view.worldFromLS) * ownLS.normal;
    OwnPlane own = OwnPlane(ownNormal, ownLS.errorRadians, ownLS.hides);
    precise vec3 fromPoint = isFar ? placeLS : placeLS - viewpoint.positionLS;
    precise vec3 toLight = mat3(view.worldFromLS) * fromPoint;
    precise float farAway = 2.0 * (casterTree.rounding.z + length(positionCS(viewpoint.positionLS)));
    float reach = isFar ? farAway : casterTree.rwsOriginCS.w;
    float lightRounding = isFar ? 0.0 : roundingAt(placeLS);
    float behind = 0.0;
#if HAS_SOFT_SHADOWS
    // A light without a size needs one ray.
    vec4 shadow = lightShadowTexel(index);
    int rays = shadow.x > 0.0 ? SHADOW_SAMPLES : 1;
    precise vec3 ahead = toLight * (1.0 / sqrt(max(dot(toLight, toLight), 1e-37)));
    precise vec3 aside = abs(ahead.x) < 0.6 ? vec3(0.0, ahead.z, -ahead.y) : vec3(-ahead.z, 0.0, ahead.x);
    precise vec3 across = aside / max(length(aside), 1e-18);
    precise vec3 up = cross(ahead, across);
    ShadowSurface surface = shadowSurface(index, isCut, shadow.x, across, up);
    vec2 random = shadowRandom(viewpoint.pixel, shadow.y);
    float third = thirdShadowRandom(viewpoint.pixel, shadow.y);
    precise float seen = 0.0;
    int i = 0;
    for (; i < rays; ++i) {
        precise vec3 toSurface = toLight + surfacePlace(surface, i, random, third);
        seen += visibilityOf(reach * toSurface, lightRounding, own, viewpoint.positionLS, behind);
    }
    if (i < rays) return CUT_LOOP; // truncated loop, as in visibilityAlong()
    float counted = float(rays) - (isCut ? behind : 0.0);
    precise float perRay = 1.0 / max(counted, 1.0);
    return seen * perRay;
#else
    return visibilityOf(reach * toLight, lightRounding, own, viewpoint.positionLS, behind);
#endif
}
