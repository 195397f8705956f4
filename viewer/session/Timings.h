#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// Cost of one drawn frame.
struct FrameTimes {
    std::uint64_t number = 0; ///< counted from 1
    double startedMs = 0.0;   ///< since program start
    double ms = 0.0;          ///< wall time, including the wait for the GPU
    double scale = 1.0;
    int side = 0; ///< of the window, drawn by this frame
    std::vector<gpu::PassTiming> passes;
    std::uint64_t kind = 0; ///< equal if a pixel costs about the same
    bool isUnlike = false;  ///< compiled shaders, or computed results that later frames reuse
    bool isPassing = false; ///< drawn while something moved
};

/// Typical cost of frames: medians.
struct TypicalTimes {
    std::size_t frames = 0;
    double ms = 0.0;
    std::vector<gpu::PassTiming> passes; ///< those of the latest frame, merged by name
};

/// The latest frames, the oldest first.
class Timings {
public:
    void add(FrameTimes frame);
    const std::deque<FrameTimes>& frames() const { return frames_; }
    void clear() { frames_.clear(); }
    /// Times of a side's frames, the oldest first.
    std::vector<float> frameMs(int side) const;
    /// Times of a pass in the frames of a side that have it: GPU time if known, else CPU time.
    std::vector<float> passMs(int side, const std::string& pass) const;
    const FrameTimes* latest(int side) const;
    /// Medians over the side's frames of the same kind and scale as its latest one. Atypical ones (isUnlike) count only
    /// if there are no others. None if the side has no frame.
    std::optional<TypicalTimes> typical(int side) const;
    /// Images per second while something moves: over the second before the latest one, as far as they follow one
    /// another without a gap. None for fewer than three.
    std::optional<double> picturesPerSecond() const;

private:
    std::deque<FrameTimes> frames_;
};

} // namespace tessera::viewer
