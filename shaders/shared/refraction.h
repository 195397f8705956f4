#pragma once
// Refraction of surfaces behind bodies of glass: blur by rough glass, ray marching in screen space, and coarser levels
// of the image behind the glass.
#include "interop.h"

#define REFRACTION_STEPS 256   // maximum steps of a screen-space ray; a shorter one takes one per pixel
#define REFRACTION_HALVINGS 10 // bisections of the step in which a ray goes behind a surface

// Coarsest level of the image; each level has half the rows and columns of the one before, 0 is the image itself.
#define BEHIND_COARSEST 6

SHARED_BEGIN

// Deflection of a transmitted ray per radian of microfacet tilt, to first order, by sin(x) = ior sin(y): x for tilts
// across the plane of incidence, y for tilts within it. Cosines: between ray and surface normal, outside and inside. An
// ior of 0 means infinite, for entering rays.
SHARED_FUNCTION vec2 turnsOfEntering(float ior, float cosOutside, float cosInside) {
    if (!(ior > 0.0f)) return vec2(1.0f, 1.0f);
    SHARED_PRECISE float across = abs(cosInside - cosOutside / ior);
    SHARED_PRECISE float along = across / max(cosInside, 1e-3f);
    return vec2(across, along);
}
SHARED_FUNCTION vec2 turnsOfLeaving(float ior, float cosOutside, float cosInside) {
    SHARED_PRECISE float across = abs(ior * cosInside - cosOutside);
    SHARED_PRECISE float along = across / max(cosOutside, 1e-3f);
    return vec2(across, along);
}

// Combined deflection of two GGX lobes in succession: neither the sum nor the root of the sum of squares, since GGX
// lobes have no finite variance. An exponent of 1.5 fits the lobes of slabs and balls as well as any (docs/glass.md).
SHARED_FUNCTION float turnsTogether(float first, float second) {
    SHARED_PRECISE float together = pow(first * sqrt(first) + second * sqrt(second), 2.0f / 3.0f);
    return together;
}

// Alpha of the GGX lobe around a ray transmitted by microfacets of `alpha`, as for a mirror at normal incidence, which
// deflects light by twice their angle. Deflections are clamped: far larger ones occur only at total reflection.
SHARED_FUNCTION float passingAlpha(float alpha, vec2 turns, float leastAlpha) {
    SHARED_PRECISE float turn = min(sqrt(turns.x * turns.y), 4.0f);
    SHARED_PRECISE float spread = clamp(0.5f * alpha * turn, leastAlpha, 1.0f);
    return spread;
}

// Lower bound of passingAlpha() relative to alpha, from any side and through any body.
SHARED_FUNCTION float leastPassingScale(float ior) {
    SHARED_PRECISE float scale = ior > 0.0f ? 0.5f * abs(ior - 1.0f) / max(ior, 1.0f) : 0.5f;
    return scale;
}

// Rows or columns of a level.
SHARED_FUNCTION int behindTexels(int pixels, int level) {
    return (pixels + (1 << level) - 1) >> level;
}

// First row of a level above 0; levels are stacked in one texture.
SHARED_FUNCTION int behindRow(int height, int level) {
    int row = 0;
    for (int finer = 1; finer < level; ++finer) row += behindTexels(height, finer);
    return row;
}

SHARED_END
