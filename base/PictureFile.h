#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/Picture.h"

namespace tessera {

/// Writes a linear image as OpenEXR: channels R, G, B, A in fp32, losslessly compressed, Rec.709 primaries, no transfer
/// function; A holds the coverage (1 or 0), and colours are not premultiplied. Every bit of R, G and B survives, NaN,
/// infinities and denormals included. Written whole or not at all; throws std::runtime_error naming the path and the
/// reason.
void writeExr(const std::string& path, const Picture& picture);
/// Encodes what writeExr() writes: the bytes of the file. Throws std::runtime_error if encoding fails.
std::vector<std::uint8_t> encodeExr(const Picture& picture);

/// Writes a display image as PNG of 8 bits per channel. Written whole or not at all; throws as writeExr does.
void writePng(const std::string& path, const DisplayImage& image);

/// A PNG file in memory.
struct Png {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes; ///< of the file
};

/// Encodes what writePng() writes. Throws std::runtime_error if encoding fails.
Png encodePng(const DisplayImage& image);
/// Encodes several in parallel, on all cores. Throws as encodePng() does.
std::vector<Png> encodePngs(std::span<const DisplayImage> images);

} // namespace tessera
