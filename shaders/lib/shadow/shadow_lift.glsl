// Shadow lift of a smooth-shaded triangle as pixels store it: a code of LIFT_BITS, which all techniques use. The
// reference tolerates the half of a step that a code may be off (validation/reference/Occlusion.cpp).
#pragma once
#include "shared/facet.h"
#include "lib/surface/camera.glsl"

// Width of a pixel at a point.
float pixelMetres(vec3 positionLS)
{
    vec2 spread = raySpread();
    vec3 step = abs(view.rayDxLS.xyz);
    precise float metres = max(max(step.x, step.y), step.z) * (spread.x + spread.y * dot(view.forwardLS.xyz, positionLS));
    return metres;
}

// Also 0 if rounding or snapped vertices move the point as far.
uint encodeLift(float metres, vec3 positionLS)
{
    precise float lost = 2e-6 * length(positionLS) + 2.0 * snappingMetres(positionLS);
#if IN_ATLAS
    return metres > lost ? floatBitsToUint(metres) : 0u; // not stored in a pixel
#else
    precise float steps = metres / (LIFT_LEAST_PIXELS * pixelMetres(positionLS));
    if (!(metres > lost && steps >= 1.0)) return 0u;
    uint bits = floatBitsToUint(min(steps, 1e30));
    uint octave = (bits >> 23) - 127u;
    uint inOctave = ((bits & 0x7fffffu) * uint(LIFT_STEPS)) >> 23;
    return min(1u + octave * uint(LIFT_STEPS) + inOctave, (1u << LIFT_BITS) - 1u);
#endif
}

float decodeLift(uint code, vec3 positionLS)
{
#if IN_ATLAS
    return uintBitsToFloat(code);
#else
    if (code == 0u) return 0.0;
    uint octave = (code - 1u) / uint(LIFT_STEPS), inOctave = (code - 1u) % uint(LIFT_STEPS);
    precise float steps = uintBitsToFloat((octave + 127u) << 23)
                          * (1.0 + (float(inOctave) + 0.5) * (1.0 / float(LIFT_STEPS)));
    precise float metres = steps * LIFT_LEAST_PIXELS * pixelMetres(positionLS);
    return metres;
#endif
}
