#include "base/Srgb.h"

#include <cmath>

namespace tessera {

// The constants are those of IEC 61966-2-1:1999; below the threshold the curve is a straight line.
double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace tessera
