#pragma once
#include <vector>

#include "base/Picture.h"

namespace tessera::validation {

/// Pixels per degree of visual angle: a monitor 0.7 m wide with 3840 pixels, 0.7 m away.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// Perceived difference of two images flipped in place, per pixel: 0 (the same) to 1, symmetric. Colours are compared
/// as visible at the viewing distance; differing edges or points raise the difference. Takes displayed images (sRGB
/// bytes) of the same size.
/// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for
/// Alternating Images".
std::vector<float> flipErrors(const DisplayImage& a, const DisplayImage& b,
                              double pixelsPerDegree = kFlipPixelsPerDegree);

} // namespace tessera::validation
