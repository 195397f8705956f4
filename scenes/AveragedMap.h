#pragma once
#include "scenes/Image.h"

namespace tessera::scenes {

/// Averages an Rgba32Float latitude-longitude map to at most `mostWidth` x `mostHeight` texels. Each texel is the mean,
/// by solid angle and in double precision, of the texels that it overlaps, which conserves energy. Opacity is 1.
Image averagedMap(const Image& map, int mostWidth, int mostHeight);

/// Averages an image to at most its own size, in the same format. Each texel is the mean, by area, of the texels that
/// it overlaps. Colours of integer `isSrgb` images are averaged in linear light, alpha as stored.
Image averagedPicture(const Image& picture, int width, int height, bool isSrgb);

} // namespace tessera::scenes
