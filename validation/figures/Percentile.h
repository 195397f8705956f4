#pragma once
#include <vector>

namespace tessera::validation {

/// The nearest-rank percentile: of n values in ascending order the ceil(n permille / 1000)-th, at least the first;
/// always one of the values, never an interpolation (500: the lower median). NaN for no values. `values` must hold no
/// NaN and come back reordered.
double nearestRank(std::vector<double>& values, int permille);

} // namespace tessera::validation
