#include "validation/figures/Tolerance.h"

#include <cmath>

#include <fmt/format.h>

namespace tessera::validation {
namespace {

constexpr double kLeastLitShare = 0.10;     // of the covered pixels; fewer lit ones prove too little
constexpr double kMostExcludedShare = 0.05; // silhouettes alone stay well under 2 %

/// Bit-identical images need no minimum of lit pixels. In others it keeps errors of a few lit pixels from hiding behind
/// the percentiles of many dark ones.
void checkSignal(std::vector<std::string>& missed, const char* name, double meanLuminance, std::size_t lit,
                 const RadianceFigures& figures) {
    if (!(meanLuminance > 0.0)) {
        missed.push_back(fmt::format("no signal: picture {} is black (mean luminance {:.3g})", name, meanLuminance));
    } else if (lit == 0) {
        missed.push_back(fmt::format("no signal: no covered pixel of picture {} is lit", name));
    } else if (figures.bitEqual != 1.0 && double(lit) < kLeastLitShare * double(figures.compared)) {
        missed.push_back(fmt::format("too little signal: only {:.3g} % of the covered pixels of picture {} are lit, at "
                                     "least 10 % must be",
                                     100.0 * double(lit) / double(figures.compared), name));
    }
}

void checkBad(std::vector<std::string>& missed, const char* where, BadPixels bad, bool mayBeNegative) {
    if (mayBeNegative) bad.negative = 0;
    if (bad.sum() > 0)
        missed.push_back(fmt::format("{} pixels: {} NaN, {} infinite, {} negative; there must be none", where, bad.nan,
                                     bad.infinite, bad.negative));
}

void checkFigure(std::vector<std::string>& missed, const char* name, double value, std::optional<double> limit,
                 bool isLeast = false) {
    if (!limit) return;
    if (std::isnan(value))
        missed.push_back(fmt::format("{} could not be measured", name));
    else if (isLeast ? value < *limit : value > *limit)
        missed.push_back(
            fmt::format("{} is {:.9g}, {} {:.9g} is required", name, value, isLeast ? "at least" : "at most", *limit));
}

} // namespace

Verdict checkTolerance(const RadianceFigures& figures, const Tolerance& tolerance) {
    Verdict verdict;
    std::vector<std::string>& missed = verdict.missed;
    checkSignal(missed, "a", figures.meanLuminanceA, figures.litCoveredA, figures);
    checkSignal(missed, "b", figures.meanLuminance, figures.litCovered, figures);
    checkBad(missed, "covered", figures.bad, tolerance.isSigned);
    checkBad(missed, "uncovered or excluded", figures.badOutside, tolerance.isSigned);
    if (figures.excluded > kMostExcludedShare)
        missed.push_back(fmt::format("{:.3g} % of the covered pixels were excluded, at most 5 % may be; edges take a "
                                     "smaller share of a larger picture, so give a larger --size",
                                     100.0 * figures.excluded));
    checkFigure(missed, "maxRel", figures.maxRel, tolerance.maxRel);
    checkFigure(missed, "bitEqual", figures.bitEqual, tolerance.bitEqual, true);
    checkFigure(missed, "relMse", figures.relMse, tolerance.relMse);
    checkFigure(missed, "p999Rel", figures.p999Rel, tolerance.p999Rel);
    if (tolerance.bias)
        checkFigure(missed, "bias (magnitude)", std::abs(figures.bias),
                    *tolerance.bias + tolerance.biasNoises * figures.biasNoise);
    verdict.ok = missed.empty();
    return verdict;
}

} // namespace tessera::validation
