#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/BenchRun.h"
#include "apps/Request.h"
#include "validation/bench/BenchMatrix.h"

namespace tessera::app {

/// What of the options of `tessera bench` its figures depend on, beside the matrix.
struct BenchJobOptions {
    FrameOptions frame; ///< its scene is not looked at
    std::vector<std::string> scenes;
    std::string against; ///< reference or forward; empty: the reference where it is affordable
    std::optional<int> frames;
};

/// The benchmark that the options ask for, with all but BenchRun::write. `reads` is told the files of every scene.
/// Throws InputError, before the first frame is drawn, for what no scene can be measured with.
BenchRun benchRunOf(
    const BenchJobOptions& options, validation::BenchMatrix matrix,
    const std::function<void(const std::vector<std::string>& files)>& reads = [](const std::vector<std::string>&) {});

/// Fills in what depends on the driver.
void settleOn(const gpu::Capabilities& gl, validation::BenchPlan& plan);

/// What the run is, of one shard and without its command.
validation::RunIdentity identityOf(const BenchJobOptions& options, const gpu::Capabilities& gl, const BenchRun& run);

} // namespace tessera::app
