#pragma once
// Subsurface constants of materials for lighting, one row each. Row 0 is for surfaces without a subsurface.
#include "interop.h"

#define SUBSURFACE_BITS 8
#define SUBSURFACE_MOST (1 << SUBSURFACE_BITS) // rows: 8 KiB, of the 16 that OpenGL 4.5 guarantees a uniform block

// Where n.l is less than this, shadow look-ups of wrapped light start (this - n.l) body radii above the surface. More
// than 0: triangles that span up to 1/60 of a turn of a round body do not shadow their neighbours at the horizon.
#define SUBSURFACE_LIFT_COSINE 0.1

SHARED_BEGIN

struct SubsurfaceConstants {
    vec4 wrap;       // rgb minus the cosine at which wrapped light ends, 0 for none; a radius of the body, m
    vec4 absorption; // rgb absorption coefficient, 1/m in the scene; a 1 if light is transmitted, else 0
};

SHARED_END
