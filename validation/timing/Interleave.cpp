#include "validation/timing/Interleave.h"

#include <cassert>

#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Timer.h"

namespace tessera::validation {

namespace {

double timedMs(const TimedFrame& frame, const glm::dvec3& eyeOffsetWS) {
    gpu::finish();
    const gpu::CpuTimer clock;
    frame(eyeOffsetWS);
    gpu::finish();
    return clock.elapsedMs();
}

} // namespace

glm::dvec3 eyeOffsetOfFrame(int index) {
    return {index % 2 == 0 ? 0.0 : 1e-3, 0.0, 0.0};
}

std::vector<std::vector<double>> timeInterleaved(std::span<const TimedFrame> kinds, const InterleaveOptions& options) {
    std::vector<std::vector<double>> timesMs(kinds.size());
    for (const std::vector<double>& round : options.earlierMs) {
        assert(round.size() == kinds.size());
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) timesMs[kind].push_back(round[kind]);
    }
    const int left = options.rounds - int(options.earlierMs.size());
    const int total = left > 0 ? options.warmUpRounds + left : 0;
    for (int round = 0; round < total; ++round) {
        std::vector<double> roundMs;
        for (const TimedFrame& kind : kinds) roundMs.push_back(timedMs(kind, eyeOffsetOfFrame(round)));
        if (round >= options.warmUpRounds) {
            for (std::size_t kind = 0; kind < kinds.size(); ++kind) timesMs[kind].push_back(roundMs[kind]);
            if (options.measured) options.measured(roundMs);
        }
        if (options.progress) options.progress(round + 1, total);
    }
    return timesMs;
}

} // namespace tessera::validation
