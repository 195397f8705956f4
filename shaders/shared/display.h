#pragma once
// Constants of the display transform.
#include "interop.h"

#define TONEMAP_NONE 0u
#define TONEMAP_KHRONOS_NEUTRAL 1u
#define TONEMAP_ACES 2u
#define TONEMAP_AGX 3u

// How the values of a view are shown (frame::DisplayMapping).
#define DISPLAY_RADIANCE 0u
#define DISPLAY_RAW 1u
#define DISPLAY_SIGNED 2u
#define DISPLAY_DISTANCE 3u
#define DISPLAY_COUNT 4u
#define DISPLAY_IDS 5u
#define DISPLAY_COMPRESSED 6u
#define DISPLAY_FAULTS 7u

SHARED_BEGIN

struct DisplayConstants {
    vec4 exposure; // x factor 2^EV
    uvec4 mapping; // x one of DISPLAY_*, y one of TONEMAP_*
};

SHARED_END
