#include "viewer/session/Timings.h"

#include <algorithm>
#include <map>

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostFrames = 240; ///< some seconds of movement; a trace of them stays small
constexpr double kRateMs = 1000.0;       ///< over which the frame rate is averaged
/// A longer gap between images, beyond twice an image's own time, means that nothing moved: twice the time after which
/// everything is idle.
constexpr double kGapMs = 300.0;

double median(std::vector<double> values) {
    const std::size_t middle = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Sums the runs of each pass, in order of their first run.
std::vector<gpu::PassTiming> summed(const std::vector<gpu::PassTiming>& runs) {
    std::vector<gpu::PassTiming> sums;
    for (const gpu::PassTiming& run : runs) {
        const auto known = std::ranges::find(sums, run.name, &gpu::PassTiming::name);
        if (known == sums.end()) {
            sums.push_back(run);
            continue;
        }
        if (run.gpuMs) known->gpuMs = known->gpuMs.value_or(0.0) + *run.gpuMs;
        known->cpuMs += run.cpuMs;
    }
    return sums;
}

} // namespace

void Timings::add(FrameTimes frame) {
    frames_.push_back(std::move(frame));
    if (frames_.size() > kMostFrames) frames_.pop_front();
}

std::vector<float> Timings::frameMs(int side) const {
    std::vector<float> values;
    for (const FrameTimes& frame : frames_)
        if (frame.side == side) values.push_back(float(frame.ms));
    return values;
}

std::vector<float> Timings::passMs(int side, const std::string& pass) const {
    std::vector<float> values;
    for (const FrameTimes& frame : frames_) {
        if (frame.side != side) continue;
        double sum = 0.0;
        bool has = false;
        for (const gpu::PassTiming& timing : frame.passes) {
            if (timing.name != pass) continue;
            has = true;
            sum += timing.gpuMs.value_or(timing.cpuMs);
        }
        if (has) values.push_back(float(sum));
    }
    return values;
}

const FrameTimes* Timings::latest(int side) const {
    const auto found =
        std::find_if(frames_.rbegin(), frames_.rend(), [&](const FrameTimes& frame) { return frame.side == side; });
    return found == frames_.rend() ? nullptr : &*found;
}

std::optional<TypicalTimes> Timings::typical(int side) const {
    const FrameTimes* const now = latest(side);
    if (now == nullptr) return std::nullopt;
    const auto isLike = [&](const FrameTimes& frame) {
        return frame.side == side && frame.kind == now->kind && frame.scale == now->scale;
    };
    const bool hasUsual =
        std::ranges::any_of(frames_, [&](const FrameTimes& frame) { return isLike(frame) && !frame.isUnlike; });
    struct Samples {
        std::vector<double> gpuMs, cpuMs;
    };
    std::vector<double> ms;
    std::map<std::string, Samples> passes;
    for (const FrameTimes& frame : frames_) {
        if (!isLike(frame) || (hasUsual && frame.isUnlike)) continue;
        ms.push_back(frame.ms);
        for (const gpu::PassTiming& pass : summed(frame.passes)) {
            if (pass.gpuMs) passes[pass.name].gpuMs.push_back(*pass.gpuMs);
            passes[pass.name].cpuMs.push_back(pass.cpuMs);
        }
    }
    TypicalTimes typical{ms.size(), median(ms), summed(now->passes)};
    for (gpu::PassTiming& pass : typical.passes) {
        const auto samples = passes.find(pass.name);
        if (samples == passes.end()) continue; // only the latest frame has it, and does not count
        if (!samples->second.gpuMs.empty()) pass.gpuMs = median(samples->second.gpuMs);
        pass.cpuMs = median(samples->second.cpuMs);
    }
    return typical;
}

std::optional<double> Timings::picturesPerSecond() const {
    constexpr int kFewest = 3;
    double last = 0.0, first = 0.0;
    int pictures = 0;
    for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
        if (frame->side != 0) continue;
        if (!frame->isPassing) break;
        if (pictures == 0) last = first = frame->startedMs;
        if (first - frame->startedMs > kGapMs + 2.0 * frame->ms) break;
        if (pictures >= kFewest && last - frame->startedMs > kRateMs) break;
        first = frame->startedMs;
        ++pictures;
    }
    if (pictures < kFewest || !(last > first)) return std::nullopt;
    return 1000.0 * (pictures - 1) / (last - first);
}

} // namespace tessera::viewer
