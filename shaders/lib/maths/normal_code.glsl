// Normals in 53 bits, as every technique lights them: what a G-buffer of 8 bytes a pixel holds, forward lights as well.
#pragma once
#include "shared/normals.h"

// The axis of the largest component and its sign, and the others as shares of it, in steps that fp32 holds exactly: half
// a step is 3e-8, and an axis is exact.
struct NormalCode {
    uvec2 shares; // NORMAL_SHARE_BITS each
    uint axis;    // 0 to 2, and 4 where the component is negative
};

// Of a vector of any length; upwards where it is too short to have a direction.
NormalCode encodeNormal(vec3 direction)
{
    vec3 size = abs(direction);
    bool isZ = size.z >= size.x && size.z >= size.y;
    bool isX = !isZ && size.x >= size.y;
    float along = isZ ? direction.z : isX ? direction.x : direction.y;
    vec2 across = isZ ? direction.xy : isX ? direction.yz : direction.xz;
    precise vec2 shares = abs(along) > 0.0 ? (across / abs(along)) * NORMAL_SHARE_STEPS : vec2(0.0);
    uint axis = (isZ ? 2u : isX ? 0u : 1u) | (along < 0.0 ? 4u : 0u);
    return NormalCode(uvec2(NORMAL_NO_SHARE + ivec2(roundEven(shares))), axis);
}

vec3 decodeNormal(NormalCode code)
{
    vec3 n = directionOfShares(code.shares, code.axis);
    precise vec3 unit = n / sqrt(dot(n, n));
    return unit;
}
