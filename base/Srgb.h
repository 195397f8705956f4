#pragma once

namespace tessera {

/// The sRGB transfer function (IEC 61966-2-1:1999) of a linear value in 0..1.
double srgbFromLinear(double linear);
/// Its inverse, for an encoded value in 0..1.
double linearFromSrgb(double encoded);

} // namespace tessera
