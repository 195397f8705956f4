#pragma once
#include <functional>
#include <string>

#include "apps/Outputs.h"
#include "renderer/gpu/Context.h"
#include "validation/bench/BenchStore.h"

namespace tessera::app {

/// A benchmark to run, or to go on with.
struct BenchRun {
    validation::BenchPlan plan;
    validation::BenchOptions options; ///< progress and keep are set by runBench()
    std::function<scenes::Scene(const validation::PlannedGroup&)> load;
    /// Called after every group, to write what is known; what is not finished is then told as such.
    std::function<void(const validation::BenchRecord&)> write;
};

/// Measures what is missing, keeps it in the store, shows progress, and returns all that the store has then. Throws
/// InputError when a scene is no longer what the plan was made from.
validation::BenchRecord runBench(gpu::Context& context, const validation::BenchStore& store, BenchRun run, bool quiet);

/// Tells the outputs what a benchmark writes into its folder: bench.json, bench.csv, and all that BenchStore keeps.
void addBenchFiles(const std::string& folder, Outputs& outputs);
/// bench.json and bench.csv of a record.
void writeBenchFiles(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record);

} // namespace tessera::app
