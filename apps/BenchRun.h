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
    validation::BenchOptions options; ///< keep and keepPicture are set by measureMissing()
    std::function<scenes::Scene(const validation::PlannedGroup&)> load;
    /// Called after every group, to write the finished groups; the others are marked as missing.
    std::function<void(const validation::BenchRecord&)> write;
};

/// Which technique to take is a question of the lit picture alone: throws InputError for a debug view.
void requireLitPicture(const frame::FrameSettings& settings, const char* command);

/// How many steps of BenchOptions::progress the missing groups take.
std::size_t stepsOf(const gpu::Capabilities& gl, const validation::BenchStore& store, const BenchRun& run);
/// Measures missing groups, saves them in the store, and returns the store's contents. Throws InputError if a scene has
/// changed since the plan was made.
validation::BenchRecord measureMissing(gpu::Context& context, const validation::BenchStore& store, BenchRun run);

/// The same with a progress bar.
validation::BenchRecord runBench(gpu::Context& context, const validation::BenchStore& store, BenchRun run, bool quiet);

/// Tells the outputs what a benchmark writes into its folder: bench.json, bench.csv, and the files of BenchStore.
void addBenchFiles(const std::string& folder, Outputs& outputs);
/// bench.json and bench.csv of a record.
void writeBenchFiles(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record);

} // namespace tessera::app
