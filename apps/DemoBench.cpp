#include "apps/DemoBench.h"

#include <cmath>
#include <filesystem>
#include <map>

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
/// Of the measured picture. A software rasteriser lights them by 257 lamps in half a second with the slowest technique.
constexpr double kMostPixels = 240.0 * 135.0;
constexpr std::size_t kLayouts = 2; ///< rows of frame::layoutTable(): the exact layout and the packed one
constexpr int kLightSteps[] = {4};  ///< the lights of the scene, divided by these

glm::ivec2 measuredSize(glm::ivec2 sizePixels) {
    const double pixels = double(sizePixels.x) * double(sizePixels.y);
    if (pixels <= kMostPixels) return sizePixels;
    const double scale = std::sqrt(kMostPixels / pixels);
    return glm::max(glm::ivec2(glm::dvec2(sizePixels) * scale + 0.5), glm::ivec2(1));
}

/// Loads the demonstration's scene with other numbers of lights. Only the first time: plan and measurement both ask.
class Scenes {
public:
    explicit Scenes(const DemoBenchRequest& demo) : options_(demo.options) {
        loaded_.emplace(options_.lights, demo.request.scene);
    }

    const scenes::Scene& with(std::optional<int> lights) {
        const auto found = loaded_.find(lights);
        if (found != loaded_.end()) return found->second;
        options_.lights = lights;
        return loaded_.emplace(lights, loadFor(options_)).first->second;
    }

private:
    FrameOptions options_;
    std::map<std::optional<int>, scenes::Scene> loaded_; ///< by number of lights
};

validation::BenchPlan planOf(const DemoBenchRequest& demo, Scenes& scenes) {
    validation::BenchMatrix matrix;
    matrix.techniques = demo.techniques;
    matrix.preferredMethodsOnly = true;
    matrix.layouts.assign(frame::layoutTable().begin(), frame::layoutTable().begin() + kLayouts);
    matrix.sizesPixels = {measuredSize(demo.request.settings.sizePixels)};
    const auto load = [&scenes](std::optional<int> count) { return scenes.with(count); };
    const frame::FrameSettings& settings = demo.request.settings;
    const int lights = int(demo.request.scene.lights.size());
    for (const int step : kLightSteps) {
        if (lights / step > 0) matrix.lights.push_back(lights / step);
    }
    validation::BenchPlan plan;
    const std::optional<int> wholeLights = demo.options.lights;
    if (!matrix.lights.empty()) validation::addToPlan(plan, matrix, demo.options.scene, wholeLights, settings, load);
    matrix.lights.clear();
    validation::addToPlan(plan, matrix, demo.options.scene, wholeLights, settings, load);
    return plan;
}

} // namespace

std::string demoBenchFolder(const std::string& folder) {
    return (fs::path(folder) / "bench").string();
}

validation::BenchRecord demoBench(gpu::Context& context, const DemoBenchRequest& demo) {
    Scenes scenes(demo);
    BenchRun run;
    run.plan = planOf(demo, scenes);
    run.options.frames = kFrames;
    const glm::ivec2 sizePixels = run.plan.groups.front().sizePixels;
    FrameOptions shown = demo.options;
    shown.settings["size"] = fmt::format("{}x{}", sizePixels.x, sizePixels.y);
    const validation::RunIdentity identity{validation::machineName(),
                                           context.capabilities().renderer,
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
    // An older demonstration that was interrupted is of no use.
    const validation::BenchStore store(folder, identity, run.plan, validation::EarlierRun::Replace);
    run.load = [&scenes](const validation::PlannedGroup& group) { return scenes.with(group.lightsToLoad); };
    run.write = [&](const validation::BenchRecord& record) { writeBenchFiles(demo.outputs, folder, record); };
    return runBench(context, store, std::move(run), demo.quiet);
}

} // namespace tessera::app
