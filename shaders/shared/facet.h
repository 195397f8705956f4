#pragma once
// Octahedral code of a triangle's geometric normal, two coordinates (lib/surface/facet.glsl,
// lib/raster/facet_normal.glsl).

#define FACET_BITS 12 // per coordinate

// Length of the stored object-space geometric normal of a lifted triangle; else 1. Its vertex normals differ, but all
// are close to the geometric normal (kMostLiftedDegrees in scenes/Shadows.h). A power of two, which keeps the mantissa.
#define LIFTED_FACET 2.0f

// Code of the shadow lift, the offset of shadow look-ups above such a triangle, relative to a pixel's width: 0 none,
// then LIFT_STEPS codes for each power of two from LIFT_LEAST_PIXELS on (lib/shadow/shadow_lift.glsl).
#define LIFT_BITS 8
#define LIFT_STEPS 12
#define LIFT_LEAST_PIXELS (1.0f / 4096.0f)

// Largest angle between a normal and its decoded code. A coordinate is off by up to 1/4094. The vector
// (x, y, 1 - |x| - |y|), at least 1/sqrt(3) long, moves by sqrt(6) of that at most: 1.04e-3. Rounding adds far less.
#define FACET_ERROR_RADIANS 1.1e-3
