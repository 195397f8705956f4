#pragma once
#include "scenes/Image.h"

namespace tessera::scenes {

/// An Rgba32Float map in latitude and longitude with so many columns and rows at most: each texel the mean over its
/// solid angle of those that it overlaps, summed in double precision, so that light stays where it is. Opacity is 1.
Image averagedMap(const Image& map, int mostWidth, int mostHeight);

/// An image of the same format with so many columns and rows, at most its own: each texel the mean of those that it
/// overlaps, by area. Colours of an `isSrgb` image of integers are averaged as light; alpha always as it is.
Image averagedPicture(const Image& picture, int width, int height, bool isSrgb);

} // namespace tessera::scenes
