#pragma once
// What materials with a subsurface are to lighting; a row each. The first says that a surface has none.
#include "interop.h"

#define SUBSURFACE_BITS 8
#define SUBSURFACE_MOST (1 << SUBSURFACE_BITS) // rows: 8 KiB, of the 16 that OpenGL 4.5 guarantees a uniform block

// Wrapped light is asked for its shadow from a point above the surface: (this - n.l) radii of the body, where n.l is
// less. More than 0, so that triangles of up to 60 to a turn do not shadow their neighbours at the horizon.
#define SUBSURFACE_LIFT_COSINE 0.1

SHARED_BEGIN

struct SubsurfaceConstants {
    vec4 wrap;       // rgb minus the cosine at which wrapped light ends, 0 where none is; a radius of the body, m
    vec4 absorption; // rgb of light that passes through, 1/m in the scene; a 1 where light does, else 0
};

SHARED_END
