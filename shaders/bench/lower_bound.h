#pragma once
// Constants shared by the lower-bound benchmark (validation/lower_bound) and its shaders.

// Range of view depths of its surface (bench/bound_surface.glsl), in metres.
#define BOUND_NEAREST_METRES 4.0
#define BOUND_FARTHEST_METRES 6.0

// Storage from which its shader reads lights (bench/light_store.glsl).
#define LIGHT_STORE_TEXEL 0 // as in every pass of a frame
#define LIGHT_STORE_UNIFORM 1
#define LIGHT_STORE_STORAGE 2

// Maximum number of lights in a uniform block, which keeps it below the 16 KiB that OpenGL 4.5 guarantees. Shapes with
// polygon corners take 36 KiB; drivers with less have no uniform store (lightStores()).
#define LIGHT_UNIFORM_LIGHTS 256
