#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera::viewer {

/// What a pass took in one frame.
struct TracePass {
    std::string name;
    double cpuMs = 0.0;
    std::optional<double> gpuMs; ///< none: not measured
};

/// A frame and its passes in order of execution.
struct TraceFrame {
    std::uint64_t number = 0;
    double startSeconds = 0.0; ///< ascending from frame to frame
    double cpuMs = 0.0;        ///< of the whole frame, at least its passes
    std::vector<TracePass> passes;
};

/// Timings as a JSON document that chrome://tracing and Perfetto open: a row for the CPU with frames and the passes in
/// them, and one for the GPU. Only durations are measured, so that passes lie end to end from their frame's start, on
/// the GPU after those of the frame before where these take longer. `renderer` names the GPU's row.
/// Source: Google, "Trace Event Format" (2016), JSON Object Format with complete and metadata events; times are
/// microseconds.
std::string chromeTrace(std::span<const TraceFrame> frames, const std::string& renderer);

} // namespace tessera::viewer
