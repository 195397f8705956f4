#pragma once
// The table of what lobes reflect of even light (renderer/frame/LobeTable.h).
#include "interop.h"

#define LOBE_TABLE_SIDE 64
#define LOBE_TABLE_IORS 24
#define LOBE_TABLE_IOR_ONE 8 // the place of index 1
#define LOBE_TABLE_LAYERS 8
#define LOBE_LAYER_GGX 0
#define LOBE_LAYER_SHEEN 1
#define LOBE_LAYER_DIELECTRIC 2 // and the next five

SHARED_BEGIN

// Where in the table an index of refraction lies, 0..LOBE_TABLE_IORS - 1: by its contrast (n - 1) / (n + 1), of either
// sign, which is the root of the reflectance at right angles. Index 1, on whose sides lobes differ most, lies at one of
// the places; above it they lie the closer the nearer to 1, where reflectances are small.
SHARED_FUNCTION float iorPlace(float ior) {
    SHARED_PRECISE float contrast = (ior - 1.0f) / (ior + 1.0f);
    float one = float(LOBE_TABLE_IOR_ONE), above = float(LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE);
    SHARED_PRECISE float place = one + (contrast > 0.0f ? above * pow(contrast, 2.0f / 3.0f) : one * contrast);
    return place;
}

SHARED_END
