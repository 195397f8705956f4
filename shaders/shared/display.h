#pragma once
// Constants of the display transform.
#include "interop.h"

#define TONEMAP_NONE 0u
#define TONEMAP_KHRONOS_NEUTRAL 1u
#define TONEMAP_ACES 2u
#define TONEMAP_AGX 3u

// Mapping from a view's values to display colours (frame::DisplayMapping).
#define DISPLAY_RADIANCE 0
#define DISPLAY_RAW 1
#define DISPLAY_SIGNED 2
#define DISPLAY_DISTANCE 3
#define DISPLAY_COUNT 4
#define DISPLAY_IDS 5
#define DISPLAY_COMPRESSED 6
#define DISPLAY_FAULTS 7
#define DISPLAY_SHADOW_ATLAS 8

SHARED_BEGIN

struct DisplayConstants {
    vec4 exposure; // x factor 2^EV
    vec4 scales;   // x log2 of the end of the count scale
};

SHARED_END
