#pragma once
#include <functional>
#include <string>

#include "apps/Outputs.h"
#include "renderer/gpu/Context.h"
#include "validation/bench/BenchStore.h"

namespace tessera::app {

/// A benchmark to run or resume.
struct BenchRun {
    validation::BenchPlan plan;
    validation::BenchOptions options; ///< keep and keepPicture are set by measureMissing()
    std::function<scenes::Scene(const validation::PlannedGroup&)> load;
    /// Called after every group, to write the finished groups; the others are marked as missing.
    std::function<void(const validation::BenchRecord&)> write;
};

/// Throws InputError for a debug view: recommendations hold for the lit image only.
void requireLitPicture(const frame::FrameSettings& settings, const char* command);

/// Number of BenchOptions::progress steps of the missing groups.
std::size_t stepsOf(const gpu::Capabilities& gl, const validation::BenchStore& store, const BenchRun& run);
/// Measures missing groups, saves them in the store, and returns the store's contents. Throws InputError if a scene has
/// changed since the plan was made.
validation::BenchRecord measureMissing(gpu::Context& context, const validation::BenchStore& store, BenchRun run);

/// measureMissing() with a progress bar.
validation::BenchRecord runBench(gpu::Context& context, const validation::BenchStore& store, BenchRun run, bool quiet);

/// Registers the outputs of a benchmark in its folder: bench.json, bench.csv, and the files of BenchStore.
void addBenchFiles(const std::string& folder, Outputs& outputs);
/// Writes a record as bench.json and bench.csv.
void writeBenchFiles(const Outputs& outputs, const std::string& folder, const validation::BenchRecord& record);

} // namespace tessera::app
