#pragma once
#include <cstdint>

namespace tessera::frame {

/// The sequence of van der Corput: the bits of a number in reverse order, as a fraction, 0 <= x < 1.
inline double vanDerCorput(std::uint32_t bits) {
    std::uint32_t turned = 0;
    for (int i = 0; i < 32; ++i, bits >>= 1) turned = (turned << 1) | (bits & 1u);
    return double(turned) * 0x1p-32;
}

} // namespace tessera::frame
