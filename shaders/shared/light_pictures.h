#pragma once
// Light textures of area lights (renderer/frame/LightPictures.h) as RGBA32F texels of a buffer texture: a header each,
// then the texels of all levels, row by row from the top left corner. Level 0 is the texture itself. Level n is
// filtered by Gaussians of the standard deviation 2^(n-1) / longer side, relative to the texture's sides, clipped at
// the light's outline and shifted so that the centroid of the remainder is the texel's centre.
#include "interop.h"

#define LIGHT_PICTURE_MOST_LEVELS 24
// Header: rgb mean over the light's surface, a longer side in texels; then xy variances of surface positions along the
// light's two axes, relative to them; then per level x first texel, yz width and height, w number of levels.
#define LIGHT_PICTURE_VARIANCES 1
#define LIGHT_PICTURE_FIRST_LEVEL 2
#define LIGHT_PICTURE_HEADER_TEXELS (LIGHT_PICTURE_FIRST_LEVEL + LIGHT_PICTURE_MOST_LEVELS)

SHARED_BEGIN

// Encoding of LightShapeTexels::attenuation.w of flat lights and of SeenLightTexels::radiance.w: 1 if two-sided, plus
// twice the number of the light texture, counted from 1.
SHARED_FUNCTION bool shinesFromBothSides(float sides) {
    return (int(sides) & 1) != 0;
}
// Index of the light texture; -1 without one.
SHARED_FUNCTION int lightPictureOf(float sides) {
    return int(sides) / 2 - 1;
}

SHARED_END
