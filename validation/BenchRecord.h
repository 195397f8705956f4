#pragma once
#include <string>

#include "validation/Bench.h"

namespace tessera::validation {

/// All that a benchmark found, as programs and people read it.
struct BenchRecord {
    std::string machine;
    std::string renderer;
    std::string commit;
    std::vector<BenchGroup> groups;
    std::vector<SkippedPoint> skipped;
    std::string recommendation;
};
inline constexpr int kBenchSchema = 1;

std::string benchJson(const BenchRecord& record);  ///< the `bench` record of the command line's documentation
std::string benchTable(const BenchRecord& record); ///< for people

/// Plain words: which of the points to take on this machine, how much faster it is than forward, how close to the
/// floor.
std::string recommend(const std::vector<BenchGroup>& groups);

/// "2 x AMD EPYC, 23 GiB, Linux".
std::string machineName();

} // namespace tessera::validation
