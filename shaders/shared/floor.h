#pragma once
// The surface of the measured lower bound (lib/floor_surface.glsl) lies between these distances ahead of its eye, in
// metres.
#include "interop.h"

#define FLOOR_NEAREST_METRES 4.0
#define FLOOR_FARTHEST_METRES 6.0
