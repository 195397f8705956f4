#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/BenchRun.h"
#include "apps/Request.h"
#include "validation/bench/BenchMatrix.h"

namespace tessera::app {

/// Options of `tessera bench` that affect its measurements, besides the matrix.
struct BenchJobOptions {
    FrameOptions frame; ///< its scene is ignored
    std::vector<std::string> scenes;
    std::string against; ///< reference or forward; empty: the reference where it is affordable
    std::optional<int> frames;
};

/// Makes the benchmark of the options; the caller sets BenchRun::write. `reads` receives the files of every scene.
/// Throws InputError, before the first frame is drawn, for options or scenes that cannot be measured.
BenchRun benchRunOf(
    const BenchJobOptions& options, validation::BenchMatrix matrix,
    const std::function<void(const std::vector<std::string>& files)>& reads = [](const std::vector<std::string>&) {});

/// Resolves the settings that depend on the driver.
void settleOn(const gpu::Capabilities& gl, validation::BenchPlan& plan);

/// Identity of the run, as its only shard and without its command.
validation::RunIdentity identityOf(const BenchJobOptions& options, const gpu::Capabilities& gl, const BenchRun& run);

} // namespace tessera::app
