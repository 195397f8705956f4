// Normals in 53 bits, as every technique lights them: what a G-buffer of 8 bytes a pixel holds, forward lights as well.
#pragma once

// The axis of the largest component and its sign, and the others as shares of it, in steps that fp32 holds exactly: half
// a step is 3e-8, and an axis is exact.
struct NormalCode {
    uvec2 shares; // NORMAL_SHARE_BITS each
    uint axis;    // 0 to 2, and 4 where the component is negative
};
#define NORMAL_SHARE_BITS 25
const int kNoShare = 1 << (NORMAL_SHARE_BITS - 1);
const float kShareSteps = float(kNoShare - 1); // from 0 to 1

// Of a vector of any length; upwards where it is too short to have a direction.
NormalCode encodeNormal(vec3 direction)
{
    vec3 size = abs(direction);
    bool isZ = size.z >= size.x && size.z >= size.y;
    bool isX = !isZ && size.x >= size.y;
    float along = isZ ? direction.z : isX ? direction.x : direction.y;
    vec2 across = isZ ? direction.xy : isX ? direction.yz : direction.xz;
    precise vec2 shares = abs(along) > 0.0 ? (across / abs(along)) * kShareSteps : vec2(0.0);
    uint axis = (isZ ? 2u : isX ? 0u : 1u) | (along < 0.0 ? 4u : 0u);
    return NormalCode(uvec2(kNoShare + ivec2(roundEven(shares))), axis);
}

vec3 decodeNormal(NormalCode code)
{
    vec2 across = vec2(ivec2(code.shares) - kNoShare);
    float along = (code.axis & 4u) != 0u ? -kShareSteps : kShareSteps;
    uint axis = code.axis & 3u;
    vec3 n = axis == 2u ? vec3(across, along) : axis == 0u ? vec3(along, across) : vec3(across.x, along, across.y);
    precise vec3 unit = n / sqrt(dot(n, n));
    return unit;
}
