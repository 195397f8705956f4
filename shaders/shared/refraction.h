#pragma once
// What bodies of glass show of the surfaces behind them: how far a rough one spreads light, how a ray is followed over
// the screen, and where coarser pictures of those surfaces lie.
#include "interop.h"

#define REFRACTION_STEPS 256   // of a ray over the screen, at most; fewer pixels take as many steps
#define REFRACTION_HALVINGS 10 // of the step in which it goes behind a surface

// Levels of the picture, of which each has half the rows and columns of the one before; 0 is the picture itself.
#define BEHIND_COARSEST 6

SHARED_BEGIN

// Deflection of a transmitted ray per radian of microfacet tilt, to first order, by
// sin(x) = ior sin(y): for tilts across the plane of incidence, then for tilts within it. Cosines are those of the
// ray to the surface's normal, outside and inside. An index of 0 is one without bound, of a ray that enters.
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

// Two lobes of GGX one behind the other, by their turns: neither their sum nor the root of that of their squares, as
// such lobes have no variance. An exponent of 1.5 is as near as any to the lobes of slabs and balls (docs/glass.md).
SHARED_FUNCTION float turnsTogether(float first, float second) {
    SHARED_PRECISE float together = pow(first * sqrt(first) + second * sqrt(second), 2.0f / 3.0f);
    return together;
}

// Alpha of the GGX lobe around a transmitted ray, as of a mirror at normal incidence, from the deflections of facets of
// `alpha`: a mirror turns light by twice the angle of its facets. Facets that turn it by far more reflect it all.
SHARED_FUNCTION float passingAlpha(float alpha, vec2 turns, float leastAlpha) {
    SHARED_PRECISE float turn = min(sqrt(turns.x * turns.y), 4.0f);
    SHARED_PRECISE float spread = clamp(0.5f * alpha * turn, leastAlpha, 1.0f);
    return spread;
}

// The least that passingAlpha() makes of an alpha, from any side and through any body.
SHARED_FUNCTION float leastPassingScale(float ior) {
    SHARED_PRECISE float scale = ior > 0.0f ? 0.5f * abs(ior - 1.0f) / max(ior, 1.0f) : 0.5f;
    return scale;
}

// Rows or columns of a level.
SHARED_FUNCTION int behindTexels(int pixels, int level) {
    return (pixels + (1 << level) - 1) >> level;
}

// First row of a level above 0: they lie one above the other in one texture.
SHARED_FUNCTION int behindRow(int height, int level) {
    int row = 0;
    for (int finer = 1; finer < level; ++finer) row += behindTexels(height, finer);
    return row;
}

SHARED_END
