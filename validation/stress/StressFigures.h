#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "validation/figures/ErrorFigures.h"
#include "validation/figures/LostGeometry.h"

namespace tessera::validation {

/// The figures of a case over all its samples.
struct StressFigures {
    std::uint64_t samples = 0;
    std::uint64_t nan = 0, infinite = 0, negative = 0; ///< samples with such a value
    /// Samples whose value depends on the sign of a rounding error, so that both results are right. Like all others
    /// they must be finite and not negative.
    std::uint64_t undecided = 0;
    double worstRel = 0.0;    ///< largest relative error against the truth
    std::string where;        ///< where it is
    double worstRelMse = 0.0; ///< largest relMse of a picture (ErrorFigures.h); 0 for cases without pictures
    std::string whereRelMse;
    std::string fault; ///< another fault, such as a picture without any light; empty: none

    /// Counts a sample of several values, once per kind of bad value.
    void count(std::span<const float> values);
    /// `describe` is called only when the error is the largest so far. NaN counts as infinitely wrong.
    template <class Describe>
    void error(double rel, const Describe& describe) {
        if (rel <= worstRel) return;
        worstRel = rel == rel ? rel : std::numeric_limits<double>::infinity();
        where = describe();
    }
    /// Adds what another run of the same case found.
    void add(const StressFigures& other);
    /// Adds a picture's figures, its errors divided by `allowed`. `what` names the picture.
    void addPicture(const RadianceFigures& picture, const std::string& what, double allowed = 1.0);
    /// Records geometry that an image lacks or has in excess.
    void geometryLost(const std::string& what, const LostGeometry& lost);
};

} // namespace tessera::validation
