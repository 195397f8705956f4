#pragma once
#include <string>

#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// The results of a benchmark, for programs and for people.
struct BenchRecord {
    std::string machine;
    std::string renderer;
    std::string driver; ///< OpenGL version string, which includes the driver's version
    std::string commit;
    std::string command; ///< reproduces the measurement
    int frames = 0;      ///< timed frames per point
    std::vector<BenchGroup> groups;
    std::vector<SkippedPoint> skipped;
    bool isComplete = false;       ///< every group of the matrix is in it
    bool isShare = false;          ///< other machines measured the missing groups
    std::size_t plannedPoints = 0; ///< points of the whole matrix
    int shards = 1;                ///< number of shards of the matrix
};

/// Since 2 `error`, `pareto`, `range`, `attribution`, `scaling` and `recommendations` are measured; since 3 the lower
/// bound of lit pairs, its 95th percentiles and its rounds; since 4 `cullNormals`; since 5 `shadow` and its settings;
/// since 6 `subsurface` and its settings; since 7 `environmentLight` and its settings; since 8 `driver`;
/// since 9 `areaLights` and its settings.
inline constexpr int kBenchSchema = 9;

std::string benchJson(const BenchRecord& record);  ///< the `bench` record of the command line's documentation
std::string benchCsv(const BenchRecord& record);   ///< its points, one per line; RFC 4180
std::string benchTable(const BenchRecord& record); ///< for people

/// What remains to be measured and how to continue, in one or two sentences; empty for a complete record.
std::string unfinishedText(const BenchRecord& record);

} // namespace tessera::validation
