#pragma once
// Light from everywhere: what lighting knows of a view's environment.
#include "interop.h"

// How its light is found: frame::EnvironmentLight has the same numbers.
#define ENVIRONMENT_OFF 0
#define ENVIRONMENT_SPLIT_SUM 1
#define ENVIRONMENT_SAMPLED 2

// Alpha of level 1 of the filtered map; level 0 is the map itself, the last level has alpha 1.
#define ENVIRONMENT_LEAST_ALPHA 0.01
#define ENVIRONMENT_IRRADIANCE_SIDE 64  // texels
#define ENVIRONMENT_BACKDROP_ALPHA 0.12 // of what a blurred backdrop shows

// RGBA32F texels of a sample of the map: xyz unit direction in the map, w its density in 1/sr; rgb radiance.
#define ENVIRONMENT_SAMPLE_TEXELS 2
// So many samples, one after the other the points of a (0, 2) sequence: any aligned run of 2^m of them is spread
// evenly.
#define ENVIRONMENT_SAMPLES_LOG2 16

SHARED_BEGIN

struct EnvironmentConstants {
    mat4 mapFromLS; // rotation
    vec4 light;     // x multiplies the map's radiance; of the filtered map y the last level, z levels a doubling of
                    // alpha, w side of level 0
};

// Texels along a level of the filtered map; two levels each have the same.
SHARED_FUNCTION int filteredSide(int side, int level) {
    return side >> ((level + 1) / 2);
}

// Where a level begins in the atlas, with its border; the irradiance follows the last one. Level 0 lies on the left,
// the others below one another on its right.
SHARED_FUNCTION uvec2 filteredOrigin(int side, int level) {
    if (level == 0) return uvec2(0u, 0u);
    int pairs = (level - 1) / 2; // of levels before it
    int above = 2 * (side - (side >> pairs)) + ((level - 1) % 2) * (side >> (pairs + 1)) + 2 * (level - 1);
    return uvec2(uint(side + 2), uint(above));
}

SHARED_END
