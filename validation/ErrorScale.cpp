#include "validation/ErrorScale.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tessera::validation {
namespace {

constexpr Rgb8 kAnchors[] = {{0x00, 0x00, 0x04}, {0x1b, 0x0c, 0x42}, {0x4b, 0x0c, 0x6b}, {0x78, 0x1c, 0x6d},
                             {0xa5, 0x2c, 0x60}, {0xcf, 0x44, 0x46}, {0xed, 0x69, 0x25}, {0xfb, 0x9a, 0x06},
                             {0xf7, 0xd0, 0x3c}, {0xfc, 0xff, 0xa4}};

std::uint8_t mix(std::uint8_t from, std::uint8_t to, double share) {
    return std::uint8_t(std::lround(double(from) + share * (double(to) - double(from))));
}

} // namespace

Rgb8 scaleColour(double position) {
    const double steps = std::clamp(position, 0.0, 1.0) * double(std::size(kAnchors) - 1);
    const std::size_t lower = std::min(std::size_t(steps), std::size(kAnchors) - 2);
    const Rgb8 from = kAnchors[lower], to = kAnchors[lower + 1];
    const double share = steps - double(lower);
    return {mix(from.r, to.r, share), mix(from.g, to.g, share), mix(from.b, to.b, share)};
}

double scalePosition(double rel) {
    if (!(rel > 0.0)) return 0.0;
    return std::clamp(1.0 - std::log10(rel) / double(kErrorScaleLowExponent), 0.0, 1.0);
}

} // namespace tessera::validation
