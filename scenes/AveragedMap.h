#pragma once
#include "scenes/Image.h"

namespace tessera::scenes {

/// An Rgba32Float map in latitude and longitude with so many columns and rows at most: each texel the mean over its
/// solid angle of those that it overlaps, summed in double precision, so that light stays where it is. Opacity is 1.
Image averagedMap(const Image& map, int mostWidth, int mostHeight);

} // namespace tessera::scenes
