#pragma once
#include <vector>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// The error that results are ranked by; none where it is not known.
std::optional<double> relMseOf(const BenchResult& result);

/// By result: whether no other of the group is at least as fast and as exact, and better in one of the two. Of results
/// that are equal in both, all are on the front. None where the error is not known; such results dominate nothing.
std::vector<std::optional<bool>> paretoFront(const BenchGroup& group);

} // namespace tessera::validation
