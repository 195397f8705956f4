#pragma once
// The table of what lobes reflect of even light (renderer/frame/LobeTable.h).
#include "interop.h"

#define LOBE_TABLE_SIDE 64
#define LOBE_TABLE_IORS 16
#define LOBE_TABLE_LAYERS 6
#define LOBE_LAYER_GGX 0
#define LOBE_LAYER_SHEEN 1
#define LOBE_LAYER_DIELECTRIC 2 // and the next three

SHARED_BEGIN

// Where in the table an index of refraction lies, 0..1: by its contrast (n - 1) / (n + 1), of either sign, which is the
// root of the reflectance at right angles. Index 1, on whose sides lobes differ most, lies at one of the places.
SHARED_FUNCTION float iorPlace(float ior) {
    SHARED_PRECISE float contrast = (ior - 1.0f) / (ior + 1.0f);
    SHARED_PRECISE float place = (8.0f + 7.0f * contrast) / float(LOBE_TABLE_IORS - 1);
    return place;
}

SHARED_END
