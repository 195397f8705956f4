#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera::viewer {

/// Times of a pass in one frame.
struct TracePass {
    std::string name;
    double cpuMs = 0.0;
    std::optional<double> gpuMs; ///< none: not measured
};

/// A frame and its passes in order of execution.
struct TraceFrame {
    std::uint64_t number = 0;
    double startSeconds = 0.0; ///< ascending
    double cpuMs = 0.0;        ///< of the whole frame, at least its passes
    std::vector<TracePass> passes;
};

/// Timings as a JSON document for chrome://tracing and Perfetto: a CPU row with frames and their passes, and a GPU row.
/// Only durations are measured, so passes lie end to end from the start of their frame; on the GPU they follow those of
/// the previous frame if these take longer. `renderer` names the GPU row.
/// Source: Google, "Trace Event Format" (2016), JSON Object Format with complete and metadata events; times are
/// microseconds.
std::string chromeTrace(std::span<const TraceFrame> frames, const std::string& renderer);

} // namespace tessera::viewer
