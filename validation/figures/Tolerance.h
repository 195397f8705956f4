#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/figures/ErrorFigures.h"

namespace tessera::validation {

/// Tolerance of an image's mean in standard errors. Unbiased errors, as of rounding and dithering, deviate by four of
/// them in one image of 16,000.
inline constexpr double kBiasNoises = 4.0;

/// The tolerances of a pair; unset ones are not checked.
struct Tolerance {
    std::optional<double> maxRel = {};   ///< at most
    std::optional<double> bitEqual = {}; ///< at least
    std::optional<double> relMse = {};   ///< at most
    std::optional<double> p999Rel = {};  ///< at most
    std::optional<double> bias = {};     ///< at most, in magnitude
    double biasNoises = 0.0;             ///< standard errors (biasNoise) by which the bias may exceed it
    bool isSigned = false;               ///< the values are directions, which may be negative; radiance may not
    std::string reason = {};             ///< why these values: one sentence
};

struct Verdict {
    bool ok = false;
    std::vector<std::string> missed; ///< one sentence each, empty exactly when ok
};

/// Checks a pair against a tolerance. Whatever the tolerance, a pair fails if one of the images has no signal (mean
/// luminance 0, no covered pixel lit, or under 10 % of them unless the pair is bit-identical: two black images never
/// pass), if any pixel is NaN, infinite or (unless isSigned) negative, or if over 5 % of the covered pixels were
/// excluded. A figure that could not be measured misses its tolerance.
Verdict checkTolerance(const RadianceFigures& figures, const Tolerance& tolerance);

} // namespace tessera::validation
