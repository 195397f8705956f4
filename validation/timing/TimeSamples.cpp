#include "validation/timing/TimeSamples.h"

#include <cassert>

#include "validation/figures/Percentile.h"

namespace tessera::validation {

TimeSpread spreadOf(std::vector<double> samples) {
    const double median = nearestRank(samples, 500);
    return {median, nearestRank(samples, 950)};
}

TimeSpread slopeSpread(std::span<const double> low, std::span<const double> high, double step) {
    assert(low.size() == high.size() && step > 0.0);
    std::vector<double> slopes;
    for (std::size_t round = 0; round < low.size(); ++round) slopes.push_back((high[round] - low[round]) / step);
    return spreadOf(std::move(slopes));
}

} // namespace tessera::validation
