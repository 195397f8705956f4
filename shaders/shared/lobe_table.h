#pragma once
// Table of lobe reflectance under uniform illumination (renderer/frame/LobeTable.h).
#include "interop.h"

#define LOBE_TABLE_SIDE 64
#define LOBE_TABLE_IORS 44
#define LOBE_TABLE_IOR_ONE 24  // position of index 1, the first of those above
#define LOBE_TABLE_CRITICAL 32 // column where total reflection ends, for indices below 1
#define LOBE_TABLE_LAYERS 13
#define LOBE_LAYER_GGX 0
#define LOBE_LAYER_SHEEN 1
#define LOBE_LAYER_DIELECTRIC 2 // and the next ten

SHARED_BEGIN

// Table position of an index of refraction, 0..LOBE_TABLE_IORS - 1, from its contrast (n - 1) / (n + 1), whose
// magnitude is the square root of the reflectance at normal incidence. Index 1, across which lobes differ most, is one
// of the positions; they are denser towards it, where the angle at which reflection rises depends most on the index.
SHARED_FUNCTION float iorPlace(float ior) {
    SHARED_PRECISE float contrast = (ior - 1.0f) / (ior + 1.0f);
    float one = float(LOBE_TABLE_IOR_ONE), above = float(LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE);
    SHARED_PRECISE float root = pow(abs(contrast), 1.0f / 3.0f);
    SHARED_PRECISE float place = one + (contrast > 0.0f ? above * root : -one * root);
    return place;
}

// Horizontal table position, 0..1, of a viewer's cosine in the layers of an index of refraction. Below index 1 total
// reflection ends at the same column for every index, so that interpolation between texels or indices does not blur
// that edge. Columns are dense near the edge and near cosine 0; above index 1 they are dense near cosine 0.
SHARED_FUNCTION float lobeColumn(float ior, float cosine) {
    if (ior >= 1.0f) return sqrt(cosine);
    const float edge = float(LOBE_TABLE_CRITICAL) / float(LOBE_TABLE_SIDE - 1);
    SHARED_PRECISE float critical = sqrt((1.0f - ior) * (1.0f + ior));
    if (cosine >= critical) {
        SHARED_PRECISE float beyond = (cosine - critical) / max(1.0f - critical, 1e-6f);
        SHARED_PRECISE float column = edge + (1.0f - edge) * sqrt(min(beyond, 1.0f));
        return column;
    }
    SHARED_PRECISE float part = cosine / critical;
    SHARED_PRECISE float share = part < 0.5f ? sqrt(0.5f * part) : 1.0f - sqrt(0.5f * (1.0f - part));
    SHARED_PRECISE float column = edge * share;
    return column;
}

SHARED_END
