#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// What one drawn frame cost.
struct FrameTimes {
    std::uint64_t number = 0; ///< counted from 1
    double startedMs = 0.0;   ///< since the program began
    double ms = 0.0;          ///< wall time, the waiting for the GPU included
    double scale = 1.0;
    int side = 0; ///< of the window, that it drew
    std::vector<gpu::PassTiming> passes;
};

/// The latest frames, the oldest first.
class Timings {
public:
    void add(FrameTimes frame);
    const std::deque<FrameTimes>& frames() const { return frames_; }
    void clear() { frames_.clear(); }
    /// What the frames of a side took, the oldest first.
    std::vector<float> frameMs(int side) const;
    /// What a pass took in the frames of a side that had it: on the GPU where that is known, else on the CPU.
    std::vector<float> passMs(int side, const std::string& pass) const;
    const FrameTimes* latest(int side) const;

private:
    std::deque<FrameTimes> frames_;
};

} // namespace tessera::viewer
