#pragma once
// Light from everywhere: what lighting knows of a view's environment.
#include "interop.h"

// How its light is found: frame::EnvironmentLight has the same numbers.
#define ENVIRONMENT_OFF 0
#define ENVIRONMENT_SPLIT_SUM 1
#define ENVIRONMENT_SAMPLED 2

// Alpha of level 0 of the filtered map; the last has alpha 1. Below it lobes see the map itself.
#define ENVIRONMENT_LEAST_ALPHA 0.01
#define ENVIRONMENT_IRRADIANCE_SIDE 64  // cells
#define ENVIRONMENT_BACKDROP_ALPHA 0.12 // of what a blurred backdrop shows

// RGBA32F texels of a sample of the map: xyz unit direction in the map, w its density in 1/sr; rgb radiance.
#define ENVIRONMENT_SAMPLE_TEXELS 2
// So many samples, one after the other the points of a (0, 2) sequence: any aligned run of 2^m of them is spread
// evenly.
#define ENVIRONMENT_SAMPLES_LOG2 16

SHARED_BEGIN

// Shaders read `light` by functions of lib/environment/environment_constants.glsl.
struct EnvironmentConstants {
    mat4 mapFromLS; // rotation
    vec4 light;     // x multiplies the map's radiance; of the filtered map y the last level, z levels a doubling of
                    // alpha, w texels along the square that they were filtered from
};

// Cells along the square of a level of the filtered map, which has a texel at each of their corners; two levels each
// have the same.
SHARED_FUNCTION int filteredSide(int side, int level) {
    return side >> (level / 2 + 1);
}

// Rows of the atlas above a level: they lie below one another, and the irradiance below the last one.
SHARED_FUNCTION int filteredTop(int side, int level) {
    int pairs = level / 2; // of levels above it
    return 2 * (side - (side >> pairs)) + (level % 2) * (side >> (pairs + 1)) + level;
}

SHARED_END
