#pragma once
#include <span>
#include <vector>

namespace tessera::validation {

/// What repeated times amount to: nearest-rank percentiles (Percentile.h), so always times that were measured.
struct TimeSpread {
    double median = 0.0;
    double p95 = 0.0;
};

/// NaN for no samples.
TimeSpread spreadOf(std::vector<double> samples);

/// Over rounds, (high - low) / step: how much time one unit more costs. Low and high of one round were measured next to
/// each other, so that a machine that changes its pace between rounds does not enter. NaN for no rounds.
TimeSpread slopeSpread(std::span<const double> low, std::span<const double> high, double step);

} // namespace tessera::validation
