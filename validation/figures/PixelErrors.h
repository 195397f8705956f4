#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/Picture.h"

namespace tessera::validation {

/// How the figures classify a pixel of a pair.
enum class PixelState : std::uint8_t {
    Compared,  ///< covered in either image, not excluded, all six values finite
    NotFinite, ///< covered and not excluded, with a NaN or an infinity in either image
    Uncovered, ///< geometry was drawn in neither image
    Excluded   ///< by the caller: its primary triangle differs between the two (silhouettes)
};

/// The relative error of image a against the truth, image b, per pixel.
struct PixelErrors {
    std::vector<PixelState> state;
    /// max over R, G, B of |a - b| / max(|b|, 1e-3 m); 0 where the pixel is not Compared.
    std::vector<double> rel;
    /// 1e-4 of the 99th percentile of b's luminance over the compared pixels; lit pixels exceed it. NaN if none.
    double litThreshold;
    /// m: the median luminance of b's lit compared pixels, at least 1e-30.
    double typicalLuminance;
};

/// `excluded` is empty or has one entry per pixel, 1 where the pixel is left out. The images have the same size.
PixelErrors pixelErrors(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded = {});

/// Luminance of linear Rec.709 R, G, B (ITU-R BT.709-6).
inline double luminance(const float* rgb) {
    return 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]);
}

bool isFinite(const float* rgb);

} // namespace tessera::validation
