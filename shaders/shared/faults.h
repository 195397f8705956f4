#pragma once
// Values that no radiance may have, and how they are painted; for C++ and GLSL alike.
#include "interop.h"

#define FAULT_NONE 0
#define FAULT_NEGATIVE 1
#define FAULT_INFINITE 2
#define FAULT_NAN 3

SHARED_BEGIN

// What is wrong with a component, from its bits, since compilers may assume that no comparison meets NaN.
SHARED_FUNCTION int faultOfBits(uint bits) {
    uint magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u) return FAULT_NAN;
    if (magnitude == 0x7F800000u) return FAULT_INFINITE;
    return bits > 0x80000000u ? FAULT_NEGATIVE : FAULT_NONE; // -0 is no fault
}

// As sRGB code values 0..1: strong colours, of which grey has none.
SHARED_FUNCTION vec3 faultColor(int fault) {
    if (fault == FAULT_NAN) return vec3(1.0f, 0.0f, 1.0f);
    return fault == FAULT_INFINITE ? vec3(0.0f, 1.0f, 1.0f) : vec3(1.0f, 1.0f, 0.0f);
}

SHARED_END
