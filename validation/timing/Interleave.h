#pragma once
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::validation {

/// One kind of frame to time. It draws the frame with the eye moved by the given metres in world space.
using TimedFrame = std::function<void(const glm::dvec3& eyeOffsetWS)>;

/// The eye offset of frame `index`: a millimetre on alternate frames, so that nothing derived from the camera can be
/// reused.
glm::dvec3 eyeOffsetOfFrame(int index);

struct InterleaveOptions {
    int warmUpRounds = 2; ///< compile programs and fill pools; not timed
    int rounds = 20;
    /// Rounds of the same kinds that were measured earlier: they count, and only the remaining ones are measured.
    std::vector<std::vector<double>> earlierMs{};
    /// Called after every timed round with its times, one per kind.
    std::function<void(std::span<const double> roundMs)> measured{};
    /// Called after every round, warm-up included; what it throws ends the measurement.
    std::function<void(int done, int total)> progress{};
};

/// Wall time of each kind of frame in milliseconds, one per round, from its first call to the return of glFinish. Kinds
/// take turns, A B C A B C, so that changes in the machine's speed affect all alike. Earlier rounds come first.
std::vector<std::vector<double>> timeInterleaved(std::span<const TimedFrame> kinds, const InterleaveOptions& options);

} // namespace tessera::validation
