// How a view's environment lies and shines.
#pragma once
#include "shared/slots.h"
#include "shared/environment.h"

layout(std140, binding = UNIFORM_ENVIRONMENT) uniform EnvironmentBlock
{
    EnvironmentConstants environment;
};

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
