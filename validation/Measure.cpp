#include "validation/Measure.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "renderer/gpu/Commands.h"

namespace tessera::validation {

namespace {

constexpr int kWarmUpFrames = 2; ///< compile shaders, fill caches
constexpr int kFrames = 7;

struct FrameTimes {
    std::vector<double> totalMs;
    std::map<std::string, std::vector<double>> passMs;
};

void drawProfiled(recipes::Renderer& renderer, recipes::Technique technique, const frame::FrameSettings& settings,
                  FrameTimes* times) {
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

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

void measurePlan(graph::Plan& plan, recipes::Renderer& renderer, recipes::Technique technique,
                 const frame::FrameSettings& settings) {
    frame::FrameSettings whole = settings;
    whole.prune = false;
    FrameTimes asPlanned, unpruned;
    renderer.backend().setProfiling(true);
    for (int i = 0; i < kWarmUpFrames + kFrames; ++i) {
        drawProfiled(renderer, technique, settings, i < kWarmUpFrames ? nullptr : &asPlanned);
        drawProfiled(renderer, technique, whole, i < kWarmUpFrames ? nullptr : &unpruned);
    }
    renderer.backend().setProfiling(false);
    for (graph::Plan::Pass& pass : plan.passes) {
        const auto times = asPlanned.passMs.find(pass.name);
        if (times != asPlanned.passMs.end()) pass.ms = median(times->second);
    }
    if (!settings.prune || plan.leftOut.empty()) return;
    const std::size_t wholeBytes = recipes::planFrame(renderer.scene(), technique, whole).bytes;
    plan.leftOut.push_back({"all of these together", "measured against prune = off",
                            wholeBytes - std::min(wholeBytes, plan.bytes),
                            median(unpruned.totalMs) - median(asPlanned.totalMs)});
}

std::vector<double> frameMs(recipes::Renderer& renderer, const std::vector<recipes::Technique>& techniques,
                            const frame::FrameSettings& settings, int frames) {
    std::vector<std::vector<double>> times(techniques.size());
    for (int i = 0; i <= frames; ++i) {
        for (std::size_t t = 0; t < techniques.size(); ++t) {
            gpu::finish();
            const auto start = std::chrono::steady_clock::now();
            renderer.draw(techniques[t], settings);
            gpu::finish();
            const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
            if (i > 0) times[t].push_back(elapsed.count()); // the first round compiles shaders
        }
    }
    std::vector<double> medians;
    for (const std::vector<double>& sample : times) medians.push_back(median(sample));
    return medians;
}

} // namespace tessera::validation
