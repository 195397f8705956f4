#pragma once
#include <string>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// All that a benchmark found, as programs and people read it.
struct BenchRecord {
    std::string machine;
    std::string renderer;
    std::string driver; ///< the version of OpenGL that it tells, and with it its own
    std::string commit;
    std::string command; ///< that measures it again
    int frames = 0;      ///< timed, of each point
    std::vector<BenchGroup> groups;
    std::vector<SkippedPoint> skipped;
    bool isComplete = false;       ///< every group of the matrix is in it
    bool isShare = false;          ///< other machines have measured the groups that it lacks
    std::size_t plannedPoints = 0; ///< of the whole matrix
    int shards = 1;                ///< that the matrix is divided among
};

/// Since 2 `error`, `pareto`, `range`, `attribution`, `scaling` and `recommendations` are measured; since 3 the lower
/// bound of lit pairs, its 95th percentiles and its rounds; since 4 `cullNormals`; since 5 `shadow` and its settings;
/// since 6 `subsurface` and its settings; since 7 `environmentLight` and its settings; since 8 `driver`;
/// since 9 `areaLights` and its settings.
inline constexpr int kBenchSchema = 9;

std::string benchJson(const BenchRecord& record);  ///< the `bench` record of the command line's documentation
std::string benchCsv(const BenchRecord& record);   ///< its points, one per line; RFC 4180
std::string benchTable(const BenchRecord& record); ///< for people

/// How much is still to be measured and how to go on, in one sentence or two; empty for a complete record.
std::string unfinishedText(const BenchRecord& record);

} // namespace tessera::validation
