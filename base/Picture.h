#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera {

/// What is compared: linear radiance, and where geometry was drawn.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<float> rgba; ///< 4 floats a pixel, rows from the top, linear Rec.709 radiance; alpha is not used
    std::vector<std::uint8_t> covered; ///< 1 where geometry was drawn, one per pixel in the same order
    bool isInteger = false;            ///< read from a file of integers: cut off at 1, and in steps

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    const float* pixel(std::size_t index) const { return &rgba[4 * index]; }
    /// Both arrays have the length that the size asks for.
    bool isConsistent() const {
        return width > 0 && height > 0 && rgba.size() == 4 * pixelCount() && covered.size() == pixelCount();
    }
};

/// What is shown: bytes that are already encoded for a display (sRGB).
struct DisplayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb; ///< 3 bytes per pixel, rows from the top

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    bool isConsistent() const { return width > 0 && height > 0 && rgb.size() == 3 * pixelCount(); }
};

/// A linear picture as a display shows it without tone map: clamped, sRGB, 8 bits; for pictures that come from a file.
DisplayImage toDisplayImage(const Picture& picture);

} // namespace tessera
