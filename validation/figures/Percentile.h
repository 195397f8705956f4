#pragma once
#include <vector>

namespace tessera::validation {

/// The nearest-rank percentile: the ceil(n permille / 1000)-th of n ascending values, at least the first. It is never
/// interpolated (500: the lower median). NaN for no values. Reorders `values`, which must hold no NaN.
double nearestRank(std::vector<double>& values, int permille);

} // namespace tessera::validation
