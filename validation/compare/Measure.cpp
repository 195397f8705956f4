#include "validation/compare/Measure.h"

#include <algorithm>
#include <map>

#include "validation/compare/RangeTruncation.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/timing/Interleave.h"
#include "validation/timing/TimeSamples.h"

namespace tessera::validation {

namespace {

constexpr int kWarmUpFrames = 2; ///< compile shaders, fill caches
constexpr int kFrames = 7;

struct ProfiledTimes {
    std::vector<double> totalMs;
    std::map<std::string, std::vector<double>> passMs;
};

void drawProfiled(engine::Renderer& renderer, engine::Technique technique, const frame::FrameSettings& settings,
                  ProfiledTimes* times) {
    renderer.draw(technique, settings);
    if (!times) return;
    double total = 0.0;
    for (const gpu::PassTiming& timing : renderer.backend().passTimings()) {
        const double ms = timing.gpuMs.value_or(timing.cpuMs);
        times->passMs[timing.name].push_back(ms);
        total += ms;
    }
    times->totalMs.push_back(total);
}

/// Fills in the bytes and entries of the frame's light lists.
void fillInLists(graph::Plan& plan, engine::Renderer& renderer, engine::Technique technique,
                 const frame::FrameSettings& settings) {
    renderer.draw(technique, settings);
    const engine::DrawnLists drawn = renderer.downloadLists();
    if (drawn.culling.method == culling::Method::None) return;
    const auto bytesOf = [](const auto& values) { return values.size() * sizeof(values[0]); };
    for (graph::Plan::Resource& resource : plan.resources) {
        if (resource.name == frame::kLightCellsName) resource.bytes = bytesOf(drawn.lists.cells);
        if (resource.name == frame::kLightEntriesName) resource.bytes = bytesOf(drawn.lists.entries);
    }
    plan.counters.emplace_back("lightListCells", drawn.lists.cells.size());
    plan.counters.emplace_back("lightListEntries", drawn.lists.entries.size());
}

} // namespace

void measurePlan(graph::Plan& plan, engine::Renderer& renderer, engine::Technique technique,
                 const frame::FrameSettings& settings) {
    frame::FrameSettings whole = settings;
    whole.prune = false;
    ProfiledTimes asPlanned, unpruned;
    renderer.backend().setProfiling(true);
    for (int i = 0; i < kWarmUpFrames + kFrames; ++i) {
        drawProfiled(renderer, technique, settings, i < kWarmUpFrames ? nullptr : &asPlanned);
        drawProfiled(renderer, technique, whole, i < kWarmUpFrames ? nullptr : &unpruned);
    }
    renderer.backend().setProfiling(false);
    for (graph::Plan::Pass& pass : plan.passes) {
        const auto times = asPlanned.passMs.find(pass.name);
        if (times != asPlanned.passMs.end()) pass.ms = spreadOf(times->second).median;
    }
    fillInLists(plan, renderer, technique, settings);
    if (settings.rangeTolerance > 0.0) {
        const RangeTruncation truncation = rangeTruncation(renderer, technique, settings);
        plan.choices.push_back({"light that the range tolerance drops", droppedText(truncation.figures),
                                truncation.technique + " measured against itself without a tolerance"});
    }
    if (!settings.prune || plan.leftOut.empty()) return;
    const std::size_t wholeBytes = engine::planFrame(renderer.scene(), technique, whole).bytes;
    plan.leftOut.push_back({"all of these together", "measured against prune = off",
                            wholeBytes - std::min(wholeBytes, plan.bytes),
                            spreadOf(unpruned.totalMs).median - spreadOf(asPlanned.totalMs).median});
}

std::vector<double> frameMs(engine::Renderer& renderer, const std::vector<engine::Technique>& techniques,
                            const frame::FrameSettings& settings, int frames) {
    std::vector<TimedFrame> kinds;
    for (const engine::Technique technique : techniques) {
        kinds.emplace_back([&renderer, &settings, technique](const glm::dvec3& eyeOffsetWS) {
            frame::FrameSettings moved = settings;
            moved.eyeOffsetWS += eyeOffsetWS;
            renderer.draw(technique, supportedSettings(technique, moved));
        });
    }
    std::vector<double> medians;
    for (std::vector<double>& times : timeInterleaved(kinds, {.warmUpRounds = 1, .rounds = frames}))
        medians.push_back(spreadOf(std::move(times)).median);
    return medians;
}

} // namespace tessera::validation
