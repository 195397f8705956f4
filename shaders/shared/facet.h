#pragma once
// The normal of a triangle (lib/raster/facet_normal.glsl) in an octahedral code of two coordinates
// (lib/surface/facet.glsl).

#define FACET_BITS 12 // a coordinate

// The largest angle between a normal and its code. A coordinate is off by up to 1/4094. The vector (x, y, 1 - |x| -
// |y|), at least 1/sqrt(3) long, moves by sqrt(6) of that at most: 1.04e-3. Rounding adds far less.
#define FACET_ERROR_RADIANS 1.1e-3
