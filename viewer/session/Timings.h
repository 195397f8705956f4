#pragma once
#include <cstdint>
#include <deque>
#include <optional>
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
    std::uint64_t kind = 0; ///< equal where a pixel costs about the same
    bool isUnlike = false;  ///< compiled shaders, or computed what later ones find
    bool isPassing = false; ///< while something moved
};

/// What frames usually cost: medians.
struct TypicalTimes {
    std::size_t frames = 0;
    double ms = 0.0;
    std::vector<gpu::PassTiming> passes; ///< those of the latest, by name; runs of a name are one
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
    /// The medians of the frames like the latest of a side: of its kind and scale. Frames that are unlike all others
    /// count only where there are none but them. None where the side has no frame.
    std::optional<TypicalTimes> typical(int side) const;
    /// Pictures in a second while something moves: over the latest second before the latest of them, as far as they
    /// follow one another. None where there are fewer than three.
    std::optional<double> picturesPerSecond() const;

private:
    std::deque<FrameTimes> frames_;
};

} // namespace tessera::viewer
