#pragma once
// Colours that tell the shadow maps of a light apart, for C++ and GLSL alike.
#include "interop.h"

SHARED_BEGIN

// Of face 0 to 5 of a light (frame::ShadowedLight), as sRGB code values 0..1: hues far apart, of which grey has none.
SHARED_FUNCTION vec3 faceColor(int face) {
    if (face == 0) return vec3(0.90f, 0.30f, 0.22f);
    if (face == 1) return vec3(0.98f, 0.82f, 0.25f);
    if (face == 2) return vec3(0.30f, 0.72f, 0.35f);
    if (face == 3) return vec3(0.30f, 0.78f, 0.92f);
    return face == 4 ? vec3(0.28f, 0.42f, 0.95f) : vec3(0.85f, 0.45f, 0.88f);
}

// Of what no face holds.
SHARED_FUNCTION vec3 noFaceColor() {
    return vec3(0.6f, 0.6f, 0.6f);
}

SHARED_END
