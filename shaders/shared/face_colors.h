#pragma once
// Colours that distinguish the shadow-map faces of a light, for C++ and GLSL.
#include "interop.h"

SHARED_BEGIN

// Colour of face 0 to 5 of a light (frame::ShadowedLight), as sRGB code values 0..1: well-separated hues, none grey.
SHARED_FUNCTION vec3 faceColor(int face) {
    if (face == 0) return vec3(0.90f, 0.30f, 0.22f);
    if (face == 1) return vec3(0.98f, 0.82f, 0.25f);
    if (face == 2) return vec3(0.30f, 0.72f, 0.35f);
    if (face == 3) return vec3(0.30f, 0.78f, 0.92f);
    return face == 4 ? vec3(0.28f, 0.42f, 0.95f) : vec3(0.85f, 0.45f, 0.88f);
}

// Colour of points outside all faces.
SHARED_FUNCTION vec3 noFaceColor() {
    return vec3(0.6f, 0.6f, 0.6f);
}

SHARED_END
