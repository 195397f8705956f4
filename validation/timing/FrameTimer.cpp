#include "validation/timing/FrameTimer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "base/Milliseconds.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Context.h"
#include "renderer/gpu/Timer.h"

namespace tessera::validation {

namespace {

/// Largest relative difference between a frame and the sum of its passes: preparing a frame and waiting between passes
/// belong to no pass. Required by the project's definition of a pass's time.
constexpr double kMostUnexplained = 0.15;

/// Backend settings that profiling changes; the destructor restores them.
class BackendSettings {
public:
    BackendSettings(gpu::GraphBackend& backend, int mostIdleFrames)
        : backend_(backend), profiling_(backend.profiling()), mostIdleFrames_(backend.mostIdleFrames()) {
        backend.setProfiling(false);
        backend.setMostIdleFrames(std::max(mostIdleFrames, mostIdleFrames_));
    }
    ~BackendSettings() {
        backend_.setProfiling(profiling_);
        backend_.setMostIdleFrames(mostIdleFrames_);
    }
    BackendSettings(const BackendSettings&) = delete;
    BackendSettings& operator=(const BackendSettings&) = delete;

private:
    gpu::GraphBackend& backend_;
    bool profiling_;
    int mostIdleFrames_;
};

void drawPoint(const TimedPoint& point, const glm::dvec3& eyeOffsetWS) {
    frame::FrameSettings settings = point.settings;
    settings.eyeOffsetWS += eyeOffsetWS;
    point.renderer->draw(point.technique, settings);
}

void leaveOut(PointTimes& times, const std::string& reason) {
    for (PassTime& pass : times.passes) pass.gpuMs.reset();
    times.gpuMs.reset();
    times.why["gpuMs"] = reason;
    times.why["passes.gpuMs"] = reason;
}

} // namespace

void summarisePasses(PointTimes& times, const std::vector<std::string>& names,
                     const std::vector<std::vector<std::optional<double>>>& passesMs, std::span<const double> frameMs) {
    times.passes.clear();
    for (const std::string& name : names) times.passes.push_back({name, {}});
    if (passesMs.empty()) return leaveOut(times, "no frame was profiled");
    std::vector<double> sums;
    for (const std::vector<std::optional<double>>& frame : passesMs) {
        assert(frame.size() == names.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < frame.size(); ++i) {
            if (!frame[i]) return leaveOut(times, fmt::format("the driver gave no time for pass '{}'", names[i]));
            sum += *frame[i];
        }
        sums.push_back(sum);
    }
    if (!frameMs.empty()) {
        assert(frameMs.size() == sums.size());
        const double sum = spreadOf(sums).median;
        const double whole = spreadOf({frameMs.begin(), frameMs.end()}).median;
        if (std::abs(sum - whole) > kMostUnexplained * whole) {
            return leaveOut(times,
                            fmt::format("the passes sum to {} ms of the {} ms of their frames, beyond "
                                        "the {:.0f} % that may be missing",
                                        millisecondsText(sum), millisecondsText(whole), 100.0 * kMostUnexplained));
        }
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::vector<double> samples;
        for (const std::vector<std::optional<double>>& frame : passesMs) samples.push_back(*frame[i]);
        times.passes[i].gpuMs = spreadOf(std::move(samples)).median;
    }
    times.gpuMs = spreadOf(std::move(sums));
}

std::vector<std::vector<double>> timeInTurn(std::span<const TimedPoint> points, std::span<const TimedFrame> others,
                                            const InterleaveOptions& options) {
    // Keeps the targets of each point allocated until its next turn.
    std::map<gpu::GraphBackend*, BackendSettings> settings;
    std::vector<TimedFrame> kinds;
    for (const TimedPoint& point : points) {
        assert(point.renderer);
        settings.try_emplace(&point.renderer->backend(), point.renderer->backend(), int(points.size()));
        kinds.emplace_back([&point](const glm::dvec3& eyeOffsetWS) { drawPoint(point, eyeOffsetWS); });
    }
    kinds.insert(kinds.end(), others.begin(), others.end());
    return timeInterleaved(kinds, options);
}

void profilePoint(PointTimes& times, const TimedPoint& point, int frames) {
    gpu::GraphBackend& backend = point.renderer->backend();
    const BackendSettings settings(backend, 1);
    const bool byClock = gpu::Context::current()->capabilities().isSoftware;
    std::vector<std::vector<gpu::PassTiming>> profiled;
    std::vector<double> frameMs;
    backend.setProfiling(byClock);
    for (int i = 0; i < frames; ++i) {
        gpu::finish();
        const gpu::CpuTimer clock;
        drawPoint(point, eyeOffsetOfFrame(i));
        gpu::finish(); // makes the timers' results available
        if (byClock) frameMs.push_back(clock.elapsedMs());
        profiled.push_back(backend.passTimings());
    }
    // Passes that fill caches, such as shadow maps, do not run in every frame.
    std::vector<std::string> names;
    for (const std::vector<gpu::PassTiming>& frame : profiled) {
        if (frame.size() <= names.size()) continue;
        names.clear();
        for (const gpu::PassTiming& timing : frame) names.push_back(timing.name);
    }
    std::vector<std::vector<std::optional<double>>> passesMs;
    for (const std::vector<gpu::PassTiming>& frame : profiled) {
        std::vector<std::optional<double>>& timesMs = passesMs.emplace_back();
        auto next = frame.begin();
        for (const std::string& name : names) {
            const bool ran = next != frame.end() && next->name == name;
            timesMs.push_back(ran ? next++->gpuMs : std::optional<double>(0.0));
        }
    }
    summarisePasses(times, names, passesMs, frameMs);
}

FrameTimes timeFrames(std::span<const TimedPoint> points, std::span<const TimedFrame> others,
                      const FrameTimerOptions& options) {
    std::vector<std::vector<double>> timesMs = timeInTurn(points, others, options.interleave);
    FrameTimes times;
    times.points.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        times.points[i].cpuMs = spreadOf(std::move(timesMs[i]));
        profilePoint(times.points[i], points[i], options.profiledFrames);
    }
    times.othersMs.assign(std::make_move_iterator(timesMs.begin() + std::ptrdiff_t(points.size())),
                          std::make_move_iterator(timesMs.end()));
    return times;
}

} // namespace tessera::validation
