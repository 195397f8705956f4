#include "validation/Interleave.h"

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
    const int total = options.warmUpRounds + options.rounds;
    for (int round = 0; round < total; ++round) {
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            const double ms = timedMs(kinds[kind], eyeOffsetOfFrame(round));
            if (round >= options.warmUpRounds) timesMs[kind].push_back(ms);
        }
        if (options.progress) options.progress(round + 1, total);
    }
    return timesMs;
}

} // namespace tessera::validation
