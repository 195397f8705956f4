#pragma once
// What bodies of glass show of the surfaces behind them: how much a rough one blurs them, how a ray is followed over
// the screen, and where coarser pictures of those surfaces lie.
#include "interop.h"

#define REFRACTION_STEPS 256   // of a ray over the screen, at most; fewer pixels take as many steps
#define REFRACTION_HALVINGS 10 // of the step in which it goes behind a surface

// Levels of the picture, of which each has half the rows and columns of the one before; 0 is the picture itself.
#define BEHIND_COARSEST 6

SHARED_BEGIN

// By how much less a rough surface spreads light that passes than light that it reflects, a factor of alpha: the less
// its index of refraction bends it. An index of 0 is one without bound. Source: the Khronos sample viewer,
// applyIorToRoughness().
SHARED_FUNCTION float passingScale(float ior) {
    SHARED_PRECISE float root = ior > 0.0f ? clamp(2.0f * ior - 2.0f, 0.0f, 1.0f) : 1.0f;
    SHARED_PRECISE float scale = root * root;
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
