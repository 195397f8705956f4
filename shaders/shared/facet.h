#pragma once
// The normal of a triangle (lib/raster/facet_normal.glsl) in an octahedral code of two coordinates
// (lib/surface/facet.glsl).

#define FACET_BITS 12 // a coordinate

// Length of the stored object-space normal of a lifted triangle, which flags it; else 1. Its corners have different
// normals, all close to its own (kMostLiftedDegrees in scenes/Shadows.h). A power of two, which moves no digit.
#define LIFTED_FACET 2.0f

// How far above such a triangle its shadows are asked for (lib/shadow/shadow_lift.glsl), in parts of a pixel's width: 1
// + LIFT_STEPS for each power of two from LIFT_LEAST_PIXELS on. 0 is none.
#define LIFT_BITS 8
#define LIFT_STEPS 12
#define LIFT_LEAST_PIXELS (1.0f / 4096.0f)

// The largest angle between a normal and its code. A coordinate is off by up to 1/4094. The vector (x, y, 1 - |x| -
// |y|), at least 1/sqrt(3) long, moves by sqrt(6) of that at most: 1.04e-3. Rounding adds far less.
#define FACET_ERROR_RADIANS 1.1e-3
