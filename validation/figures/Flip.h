#pragma once
#include <vector>

#include "base/Picture.h"

namespace tessera::validation {

/// Pixels of a degree of sight: a monitor 0.7 m wide with 3840 pixels, 0.7 m away.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// How different two pictures look when one flips between them, pixel by pixel: 0 (the same) to 1, symmetric. Colours
/// are compared as the eye sees them from that distance; where edges or points differ, the difference counts more.
/// Takes the pictures as shown (sRGB bytes), which must be of one size.
/// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for
/// Alternating Images".
std::vector<float> flipErrors(const DisplayImage& a, const DisplayImage& b,
                              double pixelsPerDegree = kFlipPixelsPerDegree);

} // namespace tessera::validation
