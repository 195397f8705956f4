// The triangle that a point lies on: it hides lights behind it, and shadow-map look-ups follow its plane.
#pragma once
#include "shared/facet.h"

// Plane through the point that hides the lights behind it: that of its triangle, or of its shading normal.
struct OwnPlane {
    vec3 normal;        // away from the viewer
    float errorRadians; // maximum error of the normal
    bool hides;         // false if the surface wraps light
};

// Whether the plane lies between the viewer and the light; `rounding`: error of `toLight`.
bool hidesBehind(OwnPlane plane, vec3 toLight, float rounding)
{
    precise float behind = dot(plane.normal, toLight);
    return plane.hides && behind > plane.errorRadians * length(toLight) + rounding;
}

// Minimum sine by which the plane of a lifted point faces the light: more than the error of the stored normal.
#define LIFTED_FACING (4.0 * FACET_ERROR_RADIANS)

// Normal of the plane that shadow-map look-ups follow from a point lifted above its triangle. The point lies on a
// curved surface that faces the light, though the triangle may not: the triangle's plane would fall away from the light
// where the surface rises towards it. So the normal is turned until the plane barely faces the light.
vec3 liftedPlaneNormal(vec3 facetNormal, vec3 toLight)
{
    precise vec3 ahead = toLight * inversesqrt(max(dot(toLight, toLight), 1e-37));
    precise float behind = dot(facetNormal, ahead);
    if (behind <= -LIFTED_FACING) return facetNormal;
    precise vec3 turned = facetNormal - (behind + LIFTED_FACING) * ahead;
    return turned * inversesqrt(max(dot(turned, turned), 1e-37));
}
