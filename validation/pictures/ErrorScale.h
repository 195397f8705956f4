#pragma once
#include "validation/pictures/BitmapFont.h"

namespace tessera::validation {

constexpr int kErrorScaleLowExponent = -7; ///< the scale runs from 1e-7 (half an fp32 step) to 1, in decades
constexpr Rgb8 kColourNotFinite = {255, 0, 255};
constexpr Rgb8 kColourUncovered = {56, 56, 58};
constexpr Rgb8 kColourExcluded = {78, 106, 124};

/// Colour of the scale at 0..1 (clamped): heatColor() of shaders/shared/heat.h.
Rgb8 scaleColour(double position);

/// Where a relative error lies on the scale: 0 at 1e-7 and below (0 included), 1 at 1 and above, logarithmic between.
double scalePosition(double rel);

} // namespace tessera::validation
