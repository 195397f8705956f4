#pragma once
// Pictures of area lights (renderer/frame/LightPictures.h) as RGBA32F texels of a buffer texture: a header each, and
// behind all headers the texels of their levels, row after row from the top left corner. Level 0 is the picture itself,
// level n its mean by Gaussians of the standard deviation 2^(n-1) / longer side, in parts of the picture's sides, cut
// at the light's outline and moved so that the mean place of what is left is the texel's.
#include "interop.h"

#define LIGHT_PICTURE_MOST_LEVELS 24
// A header: rgb the mean over the light's surface, a the longer side in texels; then xy the variances of the surface's
// places along its two vectors, in parts of them; then of each level x the texel that it begins with, yz its width and
// height, w how many levels there are.
#define LIGHT_PICTURE_VARIANCES 1
#define LIGHT_PICTURE_FIRST_LEVEL 2
#define LIGHT_PICTURE_HEADER_TEXELS (LIGHT_PICTURE_FIRST_LEVEL + LIGHT_PICTURE_MOST_LEVELS)

SHARED_BEGIN

// LightShapeTexels::attenuation.w of what is flat, and SeenLightTexels::radiance.w, say both: 1 where it shines from
// both sides, and twice the picture's number, counted from 1.
SHARED_FUNCTION bool shinesFromBothSides(float sides) {
    return (int(sides) & 1) != 0;
}
// -1 without a picture.
SHARED_FUNCTION int lightPictureOf(float sides) {
    return int(sides) / 2 - 1;
}

SHARED_END
