#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace tessera::validation {

/// A picture with shadows against the reference's: how many pixels rounding decides, and the noise of those that see
/// part of a light with a size by a few rays. Noise is judged by the definition itself, not by the nearest value that
/// it allows a pixel: a pixel may err by much, but not all of them, nor all to one side.
struct ShadowFigures {
    double undecided = 0.0; ///< share of the compared pixels where rounding decides whether a light is hidden
    std::size_t noisyPixels = 0;
    double noise = 0.0;       ///< their root mean square error by what as many independent rays would leave
    double mostNoise = 1.0;   ///< 1, and five standard errors of its square
    double ofReference = 0.0; ///< the reference's own root mean square error by theirs, as its halves differ
    double bias = 0.0;        ///< (mean a - mean b) / mean b of the sum of channels
    double biasNoise = 0.0;   ///< standard error of bias that independent rays would leave
};

/// By how many standard errors noise may stray: one picture in 10^6 does by five.
inline constexpr double kShadowNoises = 5.0;

/// What is missed, one sentence each: over 5 % of the pixels undecided; more noise than independent rays leave; a bias
/// beyond a thousandth, which is for the reference's own 1024 rays, and five standard errors. `longest` names the part
/// of the scene that takes most digits; it may be empty.
std::vector<std::string> missedByShadows(const ShadowFigures& figures, const std::string& longest = {});

/// One line for a terminal.
std::string shadowText(const ShadowFigures& figures);

} // namespace tessera::validation
