#pragma once
// Invalid radiance values and their display colours, for C++ and GLSL.
#include "interop.h"

#define FAULT_NONE 0
#define FAULT_NEGATIVE 1
#define FAULT_INFINITE 2
#define FAULT_NAN 3

SHARED_BEGIN

// Classifies a component by its bits, since compilers may assume that comparisons never see NaN.
SHARED_FUNCTION int faultOfBits(uint bits) {
    uint magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u) return FAULT_NAN;
    if (magnitude == 0x7F800000u) return FAULT_INFINITE;
    return bits > 0x80000000u ? FAULT_NEGATIVE : FAULT_NONE; // -0 is no fault
}

// Colour of a fault as sRGB code values 0..1: strong colours, none grey.
SHARED_FUNCTION vec3 faultColor(int fault) {
    if (fault == FAULT_NAN) return vec3(1.0f, 0.0f, 1.0f);
    return fault == FAULT_INFINITE ? vec3(0.0f, 1.0f, 1.0f) : vec3(1.0f, 1.0f, 0.0f);
}

SHARED_END
