#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/figures/ErrorFigures.h"

namespace tessera::validation {

/// Errors that are right in the mean over pictures, as those of rounding and dithering, leave one picture's mean off by
/// its standard error, by four of them in one picture of 16,000.
inline constexpr double kBiasNoises = 4.0;

/// The tolerances of a pair; unset ones are not checked.
struct Tolerance {
    std::optional<double> maxRel = {};   ///< at most
    std::optional<double> bitEqual = {}; ///< at least
    std::optional<double> relMse = {};   ///< at most
    std::optional<double> p999Rel = {};  ///< at most
    std::optional<double> bias = {};     ///< at most, of its magnitude
    double biasNoises = 0.0;             ///< bias may exceed that by so many of its standard errors (biasNoise)
    bool isSigned = false;               ///< directions, which may be negative; radiance may not
    std::string reason = {};             ///< why these values: one sentence
};

struct Verdict {
    bool ok = false;
    std::vector<std::string> missed; ///< one sentence each, empty exactly when ok
};

/// Whether a pair holds. Whatever the tolerance, it does not when one of the pictures has no signal (mean luminance 0,
/// no covered pixel lit, or under 10 % of them where the pair is not equal to the last bit: two black pictures never
/// pass), when any pixel is NaN, infinite or (unless isSigned) negative, or when over 5 % of the covered pixels were
/// excluded. A figure that could not be measured misses its tolerance.
Verdict checkTolerance(const RadianceFigures& figures, const Tolerance& tolerance);

} // namespace tessera::validation
