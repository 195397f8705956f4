#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera {

/// An image for comparisons: linear radiance, and coverage by geometry.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<float> rgba; ///< 4 floats per pixel, rows from the top, linear Rec.709 radiance; alpha is not used
    std::vector<std::uint8_t> covered; ///< 1 where geometry was drawn, one per pixel in the same order
    bool isInteger = false;            ///< read from an integer format: clipped at 1 and quantised

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    const float* pixel(std::size_t index) const { return &rgba[4 * index]; }
    /// Whether both arrays match the image size.
    bool isConsistent() const {
        return width > 0 && height > 0 && rgba.size() == 4 * pixelCount() && covered.size() == pixelCount();
    }
};

/// An image encoded for display (sRGB, 8 bits).
struct DisplayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb; ///< 3 bytes per pixel, rows from the top

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    bool isConsistent() const { return width > 0 && height > 0 && rgb.size() == 3 * pixelCount(); }
};

/// Encodes a linear image for display without tone mapping: clamped, sRGB, 8 bits. For images read from a file.
DisplayImage toDisplayImage(const Picture& picture);

} // namespace tessera
