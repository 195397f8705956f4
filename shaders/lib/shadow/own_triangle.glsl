// The triangle that a point lies on: it hides lights behind it, and maps are followed along its plane.
#pragma once
#include "shared/facet.h"

// A plane through the point that hides the lights behind it: of its triangle, or of the normal that it is lit with.
struct OwnPlane {
    vec3 normal;        // away from the viewer
    float errorRadians; // by how much the normal may be off
    bool hides;         // false where the surface wraps light
};

// Whether the plane lies between the viewer and the light, `rounding` being that of the way to the light.
bool hidesBehind(OwnPlane plane, vec3 toLight, float rounding)
{
    precise float behind = dot(plane.normal, toLight);
    return plane.hides && behind > plane.errorRadians * length(toLight) + rounding;
}

// How far the plane of a lifted point stays turned towards the light, as a sine: more than the stored normal may be off.
#define LIFTED_FACING (4.0 * FACET_ERROR_RADIANS)

// The normal of the plane that maps are followed along from a point above its triangle. The point lies on a curved surface
// that faces the light, though the triangle may not: the triangle's plane would fall away from the light where the surface
// rises towards it. So the normal is turned until the plane faces the light, if barely.
vec3 liftedPlaneNormal(vec3 facetNormal, vec3 toLight)
{
    precise vec3 ahead = toLight * inversesqrt(max(dot(toLight, toLight), 1e-37));
    precise float behind = dot(facetNormal, ahead);
    if (behind <= -LIFTED_FACING) return facetNormal;
    precise vec3 turned = facetNormal - (behind + LIFTED_FACING) * ahead;
    return turned * inversesqrt(max(dot(turned, turned), 1e-37));
}
