#include "viewer/session/Timings.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostFrames = 240; ///< some seconds of movement; a trace of them stays small

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

} // namespace tessera::viewer
