#include "validation/bench/Pareto.h"

#include <algorithm>

namespace tessera::validation {

std::optional<double> relMseOf(const BenchResult& result) {
    return result.error ? result.error->relMse : std::nullopt;
}

namespace {

bool dominates(const BenchResult& a, const BenchResult& b) {
    if (!relMseOf(a)) return false;
    const double timeA = a.times.cpuMs.median, timeB = b.times.cpuMs.median;
    const double errorA = *relMseOf(a), errorB = *relMseOf(b);
    return timeA <= timeB && errorA <= errorB && (timeA < timeB || errorA < errorB);
}

} // namespace

std::vector<std::optional<bool>> paretoFront(const BenchGroup& group) {
    std::vector<std::optional<bool>> front;
    for (const BenchResult& result : group.results) {
        if (!relMseOf(result)) {
            front.emplace_back();
            continue;
        }
        front.emplace_back(std::none_of(group.results.begin(), group.results.end(),
                                        [&](const BenchResult& other) { return dominates(other, result); }));
    }
    return front;
}

} // namespace tessera::validation
