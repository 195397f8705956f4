// Normals quantised to 53 bits, as every technique shades with them: forward encodes and decodes what deferred stores.
#pragma once
#include "shared/normals.h"

// Axis and sign of the largest component, and the other components as ratios to it, in steps that fp32 holds exactly.
// Half a step is 3e-8, and directions along an axis are exact.
struct NormalCode {
    uvec2 shares; // NORMAL_SHARE_BITS each
    uint axis;    // 0 to 2, plus 4 if the component is negative
};

// Encodes a vector of any length; +z if it is too short to have a direction.
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
