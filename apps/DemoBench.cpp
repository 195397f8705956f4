#include "apps/DemoBench.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "apps/BenchRun.h"
#include "apps/FrameOptionText.h"
#include "apps/OutputFolder.h"
#include "apps/Version.h"
#include "validation/bench/MachineName.h"

namespace tessera::app {

namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 5;
/// Pixel limit of the measured image. A software rasteriser shades them with 258 lights in half a second with the
/// slowest technique.
constexpr double kMostPixels = 240.0 * 135.0;
constexpr std::size_t kLayouts = 2; ///< rows of frame::layoutTable(): the exact layout and the packed one

glm::ivec2 measuredSize(glm::ivec2 sizePixels) {
    const double pixels = double(sizePixels.x) * double(sizePixels.y);
    if (pixels <= kMostPixels) return sizePixels;
    const double scale = std::sqrt(kMostPixels / pixels);
    return glm::max(glm::ivec2(glm::dvec2(sizePixels) * scale + 0.5), glm::ivec2(1));
}

validation::BenchPlan planOf(const DemoBenchRequest& demo) {
    validation::BenchMatrix matrix;
    matrix.techniques = demo.techniques;
    matrix.preferredMethodsOnly = true;
    matrix.layouts.assign(frame::layoutTable().begin(), frame::layoutTable().begin() + kLayouts);
    matrix.sizesPixels = {measuredSize(demo.request.settings.sizePixels)};
    validation::BenchPlan plan;
    validation::addToPlan(plan, matrix, demo.options.scene, demo.options.lights, demo.request.settings,
                          [&demo](std::optional<int>) { return demo.request.scene; });
    return plan;
}

} // namespace

std::string demoBenchFolder(const std::string& folder) {
    return (fs::path(folder) / "bench").string();
}

validation::BenchRecord demoBench(gpu::Context& context, const DemoBenchRequest& demo) {
    BenchRun run;
    run.plan = planOf(demo);
    run.options.frames = kFrames;
    const glm::ivec2 sizePixels = run.plan.groups.front().sizePixels;
    FrameOptions shown = demo.options;
    shown.settings["size"] = fmt::format("{}x{}", sizePixels.x, sizePixels.y);
    const validation::RunIdentity identity{validation::machineName(),
                                           context.capabilities().renderer,
                                           context.capabilities().version,
                                           kCommit,
                                           frameOptionText(shown),
                                           "",
                                           kFrames,
                                           1,
                                           1,
                                           fmt::format("tessera bench {} -o bench{} --frames {}",
                                                       shellWord(demo.options.scene), frameOptionText(shown), kFrames)};
    const std::string folder = demoBenchFolder(demo.folder);
    makeFolder(folder);
    // Replaces the results of an earlier demo.
    const validation::BenchStore store(folder, identity, run.plan, validation::EarlierRun::Replace);
    run.load = [&demo](const validation::PlannedGroup&) { return demo.request.scene; };
    run.write = [&](const validation::BenchRecord& record) { writeBenchFiles(demo.outputs, folder, record); };
    return runBench(context, store, std::move(run), demo.quiet);
}

} // namespace tessera::app
