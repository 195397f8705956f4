#include "validation/figures/Percentile.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>

namespace tessera::validation {

double nearestRank(std::vector<double>& values, int permille) {
    assert(permille >= 0 && permille <= 1000);
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    // In integers, since 0.999 * 1000 need not be 999 in floating point.
    const std::size_t rank = std::max<std::size_t>(1, (values.size() * std::size_t(permille) + 999) / 1000);
    const auto at = values.begin() + std::ptrdiff_t(rank - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace tessera::validation
