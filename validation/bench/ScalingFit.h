#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// The smallest R^2 of a reported exponent: the line then explains nine tenths of the variance of log y. Below, noise
/// or another law decides the slope.
inline constexpr double kTrendR2 = 0.9;

/// y = factor x^exponent, by least squares in the logarithms of both.
struct PowerFit {
    double exponent = 0.0;
    double factor = 0.0;
    double r2 = 0.0;      ///< fraction of the variance of log y that the line explains; 1 where y does not vary
    double mostOff = 0.0; ///< largest |y / line - 1|
    std::size_t points = 0;

    bool isTrend() const { return r2 >= kTrendR2; }
};

/// Unset with fewer than three different x: a line always fits two points, so its quality is unknown. Pairs that are
/// not both above 0 are left out.
std::optional<PowerFit> fitPower(std::span<const double> x, std::span<const double> y);

/// How the time of one kind of point grows with one quantity while the others are constant.
struct ScalingCurve {
    std::string scene;
    PointKey key;
    std::string quantity; ///< "lights", "pixels" or "evaluations"
    std::string held;     ///< "1280x720", "257 lights"; empty for evaluations, which are taken over all groups
    std::vector<double> x, timeMs;
    std::optional<PowerFit> fit;
};

/// Every curve with at least two different x.
std::vector<ScalingCurve> scalingCurves(std::span<const BenchGroup> groups);

} // namespace tessera::validation
