#pragma once
// Light from everywhere: what lighting knows of a view's environment.
#include "interop.h"

// How its light is found: frame::EnvironmentLight has the same numbers.
#define ENVIRONMENT_OFF 0
#define ENVIRONMENT_SPLIT_SUM 1
#define ENVIRONMENT_SAMPLED 2

// Alpha of level 0 of the filtered map; the last has alpha 1, and each in between the same times the one before. Below
// the first lobes see the map itself.
#define ENVIRONMENT_LEAST_ALPHA 0.01
#define ENVIRONMENT_LEVELS 10
// Texels along the square that large maps are filtered from; smaller ones are from one that is halved a few times.
#define ENVIRONMENT_MOST_SIDE 1024
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
    vec4 light;     // x multiplies the map's radiance; y halvings of ENVIRONMENT_MOST_SIDE
};

// Levels of the filtered map that alpha lies above the first.
SHARED_FUNCTION float filteredPlace(float alpha) {
    float levelsADoubling = float(ENVIRONMENT_LEVELS - 1) / -log2(float(ENVIRONMENT_LEAST_ALPHA));
    SHARED_PRECISE float place =
        log2(max(alpha, float(ENVIRONMENT_LEAST_ALPHA)) / float(ENVIRONMENT_LEAST_ALPHA)) * levelsADoubling;
    return place;
}

// Cells along the square of a level of the filtered map, which has a texel at each of their corners: as many as its
// lobe needs, the same for two levels each, but no more than the map has.
SHARED_FUNCTION int filteredSide(int halvings, int level) {
    return (ENVIRONMENT_MOST_SIDE / 2) >> max(halvings, level / 2);
}

// Rows of the atlas above a level: they lie below one another, and the irradiance below the last one.
SHARED_FUNCTION int filteredTop(int halvings, int level) {
    int pairs = level / 2; // of levels above it
    int alike = min(pairs, halvings) * filteredSide(halvings, 0);
    int smaller = (ENVIRONMENT_MOST_SIDE >> halvings) - (ENVIRONMENT_MOST_SIDE >> max(pairs, halvings));
    return 2 * (alike + smaller) + (level % 2) * filteredSide(halvings, level) + level;
}

SHARED_END
