#pragma once
// What the measured lower bound (validation/lower_bound) and its shaders share.

// Its surface (bench/bound_surface.glsl) lies between these distances ahead of its eye, in metres.
#define BOUND_NEAREST_METRES 4.0
#define BOUND_FARTHEST_METRES 6.0

// Where its shader reads lights from (bench/light_store.glsl).
#define LIGHT_STORE_TEXEL 0 // what every pass of a frame uses
#define LIGHT_STORE_UNIFORM 1
#define LIGHT_STORE_STORAGE 2

// Lights of a uniform block, which stays below the 16 KiB that OpenGL 4.5 guarantees; shapes with the corners of
// polygons take 36 KiB, and drivers without that much have no such store (lightStores()).
#define LIGHT_UNIFORM_LIGHTS 256
