#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tessera::validation {

/// An image's shadows against the reference's: how many pixels rounding decides, and the ray noise in the penumbrae of
/// lights with a size. Noise is measured against the reference itself, not against the nearest value that it allows a
/// pixel: single pixels may err by much, but not all of them, nor all to one side.
struct ShadowFigures {
    double undecided = 0.0; ///< fraction of the compared pixels where rounding decides whether a light is hidden
    std::size_t noisyPixels = 0;
    double noise = 0.0; ///< RMS error of the noisy pixels over that of as many independent rays
    /// Limit of `noise`: sqrt(1 + five standard errors of its square). Unset where the image's other errors, which
    /// `noise` and `bias` contain, have no tolerance: then neither is judged.
    std::optional<double> mostNoise = 1.0;
    double ofReference = 0.0; ///< the reference's RMS error over the image's, from the difference of its halves
    double bias = 0.0;        ///< (mean a - mean b) / mean b of the sum of channels
    double biasNoise = 0.0;   ///< standard error of bias with independent rays
};

/// Tolerance of noise in standard errors: one image in 10^6 deviates by five.
inline constexpr double kShadowNoises = 5.0;

/// Failed checks, one sentence each: over 5 % of the pixels undecided; more noise than independent rays leave; a bias
/// beyond a thousandth (for the reference's own 1024 rays) plus five standard errors. Without mostNoise only the first
/// is checked. `longest` names the part of the scene that needs most digits; it may be empty.
std::vector<std::string> missedByShadows(const ShadowFigures& figures, const std::string& longest = {});

/// One line for a terminal.
std::string shadowText(const ShadowFigures& figures);

} // namespace tessera::validation
