#pragma once
#include <span>
#include <vector>

namespace tessera::validation {

/// Statistics of repeated times: nearest-rank percentiles (Percentile.h), which are always measured values.
struct TimeSpread {
    double median = 0.0;
    double p95 = 0.0;
};

/// NaN for no samples.
TimeSpread spreadOf(std::vector<double> samples);

/// Statistics over rounds of (high - low) / step: the time of one more unit. Low and high of a round are measured next
/// to each other, so that changes in the machine's speed between rounds cancel. NaN for no rounds.
TimeSpread slopeSpread(std::span<const double> low, std::span<const double> high, double step);

} // namespace tessera::validation
