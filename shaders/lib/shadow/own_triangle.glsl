// The triangle that a point lies on: it hides lights behind it, and maps are followed along its plane.
#pragma once
#include "shared/facet.h"
#include "lib/surface/camera.glsl"

// The largest angle between its normal and what depths and a code of 24 bits leave of it.
float facetErrorRadians()
{
    return FACET_ERROR_RADIANS + view.depthKey.z;
}

// Whether the triangle lies between the viewer and the light, `rounding` being that of the way to the light.
bool isBehindFacet(vec3 facetNormal, vec3 toLight, float rounding)
{
    precise float behind = dot(facetNormal, toLight);
    return behind > facetErrorRadians() * length(toLight) + rounding;
}
