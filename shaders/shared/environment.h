#pragma once
// Constants of a view's environment lighting.
#include "interop.h"

// Lighting algorithm; frame::EnvironmentLight has the same numbers.
#define ENVIRONMENT_OFF 0
#define ENVIRONMENT_SPLIT_SUM 1
#define ENVIRONMENT_SAMPLED 2

// Alpha of level 0 of the filtered map; alphas grow by a constant factor per level to 1 at the last. Below the first,
// lobes read the unfiltered map.
#define ENVIRONMENT_LEAST_ALPHA 0.01
#define ENVIRONMENT_LEVELS 10
// Side in texels of the square that large maps are filtered from; smaller maps use one that is halved a few times.
#define ENVIRONMENT_MOST_SIDE 1024
#define ENVIRONMENT_IRRADIANCE_SIDE 64  // cells
#define ENVIRONMENT_BACKDROP_ALPHA 0.12 // alpha of a blurred backdrop

// RGBA32F texels per sample of the map: xyz unit direction in the map, w its density in 1/sr; rgb radiance.
#define ENVIRONMENT_SAMPLE_TEXELS 2
// log2 of the number of samples, in the order of a (0, 2) sequence: any aligned run of 2^m samples is evenly spread.
#define ENVIRONMENT_SAMPLES_LOG2 16

SHARED_BEGIN

// Shaders read `light` through lib/environment/environment_constants.glsl.
struct EnvironmentConstants {
    mat4 mapFromLS; // rotation
    vec4 light;     // x factor of the map's radiance; y number of halvings of ENVIRONMENT_MOST_SIDE
};

// Fractional level of the filtered map for an alpha.
SHARED_FUNCTION float filteredPlace(float alpha) {
    float levelsADoubling = float(ENVIRONMENT_LEVELS - 1) / -log2(float(ENVIRONMENT_LEAST_ALPHA));
    SHARED_PRECISE float place =
        log2(max(alpha, float(ENVIRONMENT_LEAST_ALPHA)) / float(ENVIRONMENT_LEAST_ALPHA)) * levelsADoubling;
    return place;
}

// Cells along the side of a level of the filtered map, with a texel at each cell corner: as many as its lobe needs,
// equal for pairs of levels, and no more than the map has.
SHARED_FUNCTION int filteredSide(int halvings, int level) {
    return (ENVIRONMENT_MOST_SIDE / 2) >> max(halvings, level / 2);
}

// First atlas row of a level; levels are stacked from the top, the irradiance map last.
SHARED_FUNCTION int filteredTop(int halvings, int level) {
    int pairs = level / 2; // pairs of levels above it
    int alike = min(pairs, halvings) * filteredSide(halvings, 0);
    int smaller = (ENVIRONMENT_MOST_SIDE >> halvings) - (ENVIRONMENT_MOST_SIDE >> max(pairs, halvings));
    return 2 * (alike + smaller) + (level % 2) * filteredSide(halvings, level) + level;
}

SHARED_END
