// Orientation and intensity of a view's environment.
#pragma once
#include "shared/slots.h"
#include "shared/environment.h"
#include "lib/surface/surface.glsl"

layout(std140, binding = UNIFORM_ENVIRONMENT) uniform EnvironmentBlock
{
    EnvironmentConstants environment;
};

float environmentIntensity() // multiplies the map's radiance
{
    return environment.light.x;
}

int filteredHalvings() // number of halvings of ENVIRONMENT_MOST_SIDE, for the levels of the filtered map
{
    return int(environment.light.y);
}

vec3 mapDirection(vec3 directionLS)
{
    precise vec3 direction = mat3(environment.mapFromLS) * directionLS;
    return direction;
}

vec3 fromMapDirection(vec3 direction)
{
    precise vec3 directionLS = direction * mat3(environment.mapFromLS); // by the transpose
    return directionLS;
}

// Fraction of the environment's light that reaches a surface, from its occlusion texture.
float openShare(Surface surface)
{
#if HAS_OCCLUSION_TEXTURE
    return decodeOpen(surface.openCode);
#else
    return 1.0;
#endif
}
