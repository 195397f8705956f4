// The triangle that a point lies on: it hides lights behind it, and maps are followed along its plane.
#pragma once
#include "shared/facet.h"

// Whether the triangle lies between the viewer and the light, `rounding` being that of the way to the light.
bool isBehindFacet(vec3 facetNormal, vec3 toLight, float rounding)
{
    precise float behind = dot(facetNormal, toLight);
    return behind > FACET_ERROR_RADIANS * length(toLight) + rounding;
}
