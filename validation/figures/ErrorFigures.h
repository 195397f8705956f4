#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/Picture.h"
#include "validation/figures/PixelErrors.h"

namespace tessera::validation {

/// Differences of a pair on an 8 bit display, over its compared pixels. A missing figure has a reason.
struct DisplayFigures {
    /// Peak signal-to-noise ratio in dB; empty when the bytes are identical, where it is infinite.
    std::optional<double> psnr;
    std::optional<double> flip; ///< mean of flipErrors(): 0 (the same) to 1
    std::string psnrReason, flipReason;
};

/// `state` has one entry per pixel. The images must have the same size.
DisplayFigures displayFigures(const DisplayImage& a, const DisplayImage& b, std::span<const PixelState> state);

/// Counts of pixels with values that radiance cannot have. A pixel counts once per kind, however many of its channels
/// have it.
struct BadPixels {
    std::size_t nan = 0;
    std::size_t infinite = 0;
    std::size_t negative = 0; ///< below 0: not -0, but -infinity (which is infinite too)
    std::size_t sum() const { return nan + infinite + negative; }
};

/// The error of image a's radiance against the truth, image b. Pixels are "covered" where geometry was drawn in either
/// image, minus the excluded ones; "lit" where luminance exceeds 1e-4 of the 99th percentile of b's. Percentiles are
/// nearest-rank. A covered pixel with a NaN or an infinity counts in `covered`, `bad` and bitEqual. All other figures,
/// DisplayFigures too, leave it out, since it would swamp the other pixels. A pair with such a pixel never passes
/// (checkTolerance). A figure that could not be measured is NaN.
struct RadianceFigures {
    std::size_t covered = 0;  ///< pixels, also the non-finite ones
    std::size_t compared = 0; ///< covered pixels with six finite values
    double maxAbs;            ///< largest |a - b| of a channel
    double maxRel;            ///< rel = |a - b| / max(|b|, 1e-3 m); a pixel's is its worst channel's
    std::size_t worstX = 0;   ///< pixel of maxRel, from the left
    std::size_t worstY = 0;   ///< from the top
    double rmse;              ///< root of the mean over channels and pixels of (a - b)^2
    double relMse;            ///< mean over channels and pixels of (a - b)^2 / (b^2 + 1e-2 m^2)
    double p50Rel;
    double p99Rel;
    double p999Rel;
    double bias;      ///< (mean a - mean b) / mean b, of luminance
    double biasNoise; ///< standard error of bias if the pixels' errors are independent
    double bitEqual;  ///< fraction of covered pixels with equal bit patterns in R, G and B, +0 = -0

    BadPixels bad;        ///< covered pixels, bad in a or in b
    BadPixels badA, badB; ///< covered pixels, by image
    BadPixels badOutside; ///< uncovered or excluded pixels, bad in a or in b

    double excluded = 0.0;       ///< excluded fraction of the pixels covered in either image
    double litShare;             ///< fraction of all pixels of b that are lit
    std::size_t litCovered = 0;  ///< compared pixels of b that are lit
    std::size_t litCoveredA = 0; ///< compared pixels of a that are lit by b's threshold
    double meanLuminance;        ///< of b, over all its finite pixels; of a: meanLuminanceA
    double meanLuminanceA;
    double typicalLuminance; ///< m: median luminance of b's lit covered pixels, at least 1e-30

    /// Lit fraction of the compared pixels of b.
    double litCoveredShare() const { return compared > 0 ? double(litCovered) / double(compared) : 0.0; }
};

/// All figures of a pair.
struct ErrorFigures : RadianceFigures, DisplayFigures {};

/// `excluded` is empty or has one entry per pixel, 1 where the pixel is left out. The images must have the same size
/// (requireSameSize).
RadianceFigures radianceFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded = {});

/// A pair as displayed. If unset, radiance is displayed without exposure and tone map: clamped to 0..1, sRGB.
struct ShownPair {
    const DisplayImage* a = nullptr;
    const DisplayImage* b = nullptr;
};

/// radianceFigures() and displayFigures() of a pair. FLIP takes longer than all the others together.
ErrorFigures errorFigures(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded = {},
                          const ShownPair& shown = {});

/// Throws InputError naming both images and their sizes if they differ.
void requireSameSize(const Picture& a, const std::string& nameA, const Picture& b, const std::string& nameB);

} // namespace tessera::validation
