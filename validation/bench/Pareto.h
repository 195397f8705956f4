#pragma once
#include <vector>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// The error that results are ranked by; unset if unknown.
std::optional<double> relMseOf(const BenchResult& result);

/// Per result, whether it is on the Pareto front: no other of the group is at least as fast and as exact, and better in
/// one of the two. Equal results are all on the front. Unset if the error is unknown; such results dominate nothing.
std::vector<std::optional<bool>> paretoFront(const BenchGroup& group);

} // namespace tessera::validation
