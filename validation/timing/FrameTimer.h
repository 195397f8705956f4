#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/Renderer.h"
#include "validation/timing/Interleave.h"
#include "validation/timing/TimeSamples.h"

namespace tessera::validation {

/// One frame to time. Points of several scenes have a renderer each, all on one context.
struct TimedPoint {
    engine::Renderer* renderer = nullptr;
    engine::Technique technique = engine::Technique::Forward;
    frame::FrameSettings settings;
};

struct PassTime {
    std::string name;
    std::optional<double> gpuMs; ///< median; unset with a reason in PointTimes::why
};

struct PointTimes {
    TimeSpread cpuMs;                       ///< of whole frames, culling and uploads on the CPU included
    std::optional<TimeSpread> gpuMs;        ///< of the sum of a frame's passes
    std::vector<PassTime> passes;           ///< in order of execution
    std::map<std::string, std::string> why; ///< field -> why it could not be measured
};

struct FrameTimerOptions {
    InterleaveOptions interleave;
    int profiledFrames = 7; ///< drawn afterwards, for the times of passes
};

struct FrameTimes {
    std::vector<PointTimes> points;            ///< parallel to the requested points
    std::vector<std::vector<double>> othersMs; ///< parallel to the other requested frames, one time per round
};

/// Wall times of whole frames that take turns (timeInterleaved): of the points, then of `others`.
std::vector<std::vector<double>> timeInTurn(std::span<const TimedPoint> points, std::span<const TimedFrame> others,
                                            const InterleaveOptions& options);

/// Fills in the times of passes, from frames drawn only for that.
void profilePoint(PointTimes& times, const TimedPoint& point, int frames = FrameTimerOptions{}.profiledFrames);

/// Times frames that take turns (timeInterleaved); `others` are further frames of the same run, such as those of the
/// lower bound. Pass times come from separate frames: from GPU timers, or on software rasterisers, whose GPU timers are
/// meaningless, from glFinish and the CPU clock around the pass, and then only if the passes sum to within 15 % of the
/// frame. Nothing is read back. Throws what drawing throws.
FrameTimes timeFrames(std::span<const TimedPoint> points, std::span<const TimedFrame> others = {},
                      const FrameTimerOptions& options = {});

/// Summarises profiled frames: `passesMs` by frame and pass, `frameMs` the wall time of each frame, or empty if the
/// passes need not sum to it. Fills in gpuMs, passes and why.
void summarisePasses(PointTimes& times, const std::vector<std::string>& names,
                     const std::vector<std::vector<std::optional<double>>>& passesMs, std::span<const double> frameMs);

} // namespace tessera::validation
