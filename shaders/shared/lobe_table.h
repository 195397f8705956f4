#pragma once
// The table of what lobes reflect of even light (renderer/frame/LobeTable.h).
#include "interop.h"

#define LOBE_TABLE_SIDE 64
#define LOBE_TABLE_IORS 44
#define LOBE_TABLE_IOR_ONE 24  // the place of index 1, and the first of those above
#define LOBE_TABLE_CRITICAL 32 // the column at which total reflection ends, of indices below 1
#define LOBE_TABLE_LAYERS 13
#define LOBE_LAYER_GGX 0
#define LOBE_LAYER_SHEEN 1
#define LOBE_LAYER_DIELECTRIC 2 // and the next ten

SHARED_BEGIN

// Where in the table an index of refraction lies, 0..LOBE_TABLE_IORS - 1: by its contrast (n - 1) / (n + 1), of either
// sign, which is the root of the reflectance at right angles. Index 1, on whose sides lobes differ most, lies at one of
// the places; on both sides they lie the closer the nearer to 1, where the angle at which reflection grows depends most
// on the index.
SHARED_FUNCTION float iorPlace(float ior) {
    SHARED_PRECISE float contrast = (ior - 1.0f) / (ior + 1.0f);
    float one = float(LOBE_TABLE_IOR_ONE), above = float(LOBE_TABLE_IORS - 1 - LOBE_TABLE_IOR_ONE);
    SHARED_PRECISE float root = pow(abs(contrast), 1.0f / 3.0f);
    SHARED_PRECISE float place = one + (contrast > 0.0f ? above * root : -one * root);
    return place;
}

// Where between left and right, 0..1, a viewer's cosine of 0 to 1 lies in the layers of an index of refraction. Below
// index 1 total reflection ends at the same column for each of them, so that no edge lies between two of its texels or
// at different places of two indices: columns are close there, and on its left at 0, as they are at 0 above index 1.
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
