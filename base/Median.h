#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace tessera {

/// The upper median; 0 for an empty list.
inline double medianOf(std::vector<double> numbers) {
    if (numbers.empty()) return 0.0;
    const auto middle = numbers.begin() + std::ptrdiff_t(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

} // namespace tessera
