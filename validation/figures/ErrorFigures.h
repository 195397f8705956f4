#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/Picture.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {

/// How a pair differs on an 8 bit display, over its compared pixels. A figure that is not there has a reason.
struct DisplayFigures {
    /// Peak signal to noise in dB; none when the bytes are identical, where it is infinite.
    std::optional<double> psnr;
    std::optional<double> flip; ///< mean of flipErrors(): 0 (the same) to 1
    std::string psnrReason, flipReason;
};

/// `state` has one entry per pixel. The pictures must be of one size.
DisplayFigures displayFigures(const DisplayImage& a, const DisplayImage& b, std::span<const PixelState> state);

/// Pixels that hold a value which radiance cannot have; a pixel counts once per kind, whatever the number of its
/// channels.
struct BadPixels {
    std::size_t nan = 0;
    std::size_t infinite = 0;
    std::size_t negative = 0; ///< below zero; -0 is not, -infinity is (and is infinite too)
    std::size_t sum() const { return nan + infinite + negative; }
};

/// The error of picture a's radiance against the truth b's. Pixels are "covered" where geometry was drawn in either
/// picture, minus the excluded ones; "lit" where luminance exceeds 1e-4 of the 99th percentile of b's. Percentiles are
/// nearest-rank. A covered pixel with a NaN or an infinity is counted in `bad` and takes part in bitEqual; all other
/// figures leave it out, DisplayFigures too, for they would say nothing about the rest. A pair with such a pixel never
/// passes (checkTolerance). A figure that could not be measured is NaN.
struct RadianceFigures {
    std::size_t covered = 0;  ///< pixels, the not finite ones included
    std::size_t compared = 0; ///< of them, with six finite values
    double maxAbs;            ///< largest |a - b| of a channel
    double maxRel;            ///< rel = |a - b| / max(|b|, 1e-3 m); a pixel's is its worst channel's
    std::size_t worstX = 0;   ///< where maxRel is, from the left
    std::size_t worstY = 0;   ///< from the top
    double rmse;              ///< root of the mean over channels and pixels of (a - b)^2
    double relMse;            ///< mean over channels and pixels of (a - b)^2 / (b^2 + 1e-2 m^2)
    double p50Rel;
    double p99Rel;
    double p999Rel;
    double bias;      ///< (mean a - mean b) / mean b, of luminance
    double biasNoise; ///< standard error of bias where the pixels' errors are independent of each other
    double bitEqual;  ///< share of covered pixels with equal bit patterns in R, G and B, +0 = -0

    BadPixels bad;        ///< covered pixels, bad in a or in b
    BadPixels badA, badB; ///< covered pixels, by picture
    BadPixels badOutside; ///< pixels that are not covered, or excluded; bad in a or in b

    double excluded = 0.0;       ///< share of the pixels covered in either picture that were excluded
    double litShare;             ///< share of all pixels of b that are lit
    std::size_t litCovered = 0;  ///< compared pixels of b that are lit
    std::size_t litCoveredA = 0; ///< of a, by b's threshold
    double meanLuminance;        ///< of b, over all its finite pixels; of a: meanLuminanceA
    double meanLuminanceA;
    double typicalLuminance; ///< m: median luminance of b's lit covered pixels, at least 1e-30

    /// Of the compared pixels.
    double litCoveredShare() const { return compared > 0 ? double(litCovered) / double(compared) : 0.0; }
};

/// All that is measured of a pair.
struct ErrorFigures : RadianceFigures, DisplayFigures {};

/// `excluded` is empty or one entry per pixel, 1 where the pixel is left out. The pictures must be of one size (see
/// requireSameSize).
RadianceFigures radianceFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded = {});

/// A pair as it is shown; without it as a display shows radiance without exposure and tone map: clamped to 0..1, sRGB.
struct ShownPair {
    const DisplayImage* a = nullptr;
    const DisplayImage* b = nullptr;
};

/// radianceFigures() and displayFigures() of a pair. FLIP takes longer than all the others together.
ErrorFigures errorFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded = {},
                          const ShownPair& shown = {});

/// Throws InputError naming both pictures and their sizes when they differ.
void requireSameSize(const Picture& a, const std::string& nameA, const Picture& b, const std::string& nameB);

} // namespace tessera::validation
