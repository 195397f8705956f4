#include "viewer/show/ResolutionScale.h"

#include <algorithm>
#include <cmath>

namespace tessera::viewer {
namespace {

/// Of the latest picture, against those before.
constexpr double kFreshShare = 0.5;
/// A larger picture must fit by prediction with this much room, so that the scale does not flicker.
constexpr double kRoom = 0.85;
/// What smaller pictures must save for it to be worth their being smaller.
constexpr double kWorthwhile = 1.25;

std::size_t stepOf(double scale) {
    std::size_t step = 0;
    while (step + 1 < kScales.size() && kScales[step] > scale * 1.001) ++step;
    return step;
}

double pixelsOf(std::size_t step) {
    return kScales[step] * kScales[step];
}

} // namespace

/// The line of least relative error through what was taken; neither of its parts is negative.
ResolutionScale::Cost ResolutionScale::cost() const {
    double weights = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t step = 0; step < kScales.size(); ++step) {
        if (!takenMs_[step]) continue;
        const double weight = 1.0 / std::max(*takenMs_[step] * *takenMs_[step], 1e-6);
        weights += weight;
        x += weight * pixelsOf(step);
        y += weight * *takenMs_[step];
        xx += weight * pixelsOf(step) * pixelsOf(step);
        xy += weight * pixelsOf(step) * *takenMs_[step];
    }
    if (weights == 0.0) return {};
    const double spread = weights * xx - x * x;
    if (spread <= 1e-9 * weights * xx) return {0.0, xy / xx}; // one scale: as if pixels were all that costs
    const double wholeMs = std::max((weights * xy - x * y) / spread, 0.0);
    const double frameMs = (y - wholeMs * x) / weights;
    if (frameMs >= 0.0) return {frameMs, wholeMs};
    return {0.0, xy / xx};
}

double ResolutionScale::predictedMs(std::size_t step) const {
    if (takenMs_[step]) return *takenMs_[step];
    const Cost known = cost();
    return known.frameMs + known.wholeMs * pixelsOf(step);
}

void ResolutionScale::drew(double scale, double ms) {
    std::optional<double>& taken = takenMs_[stepOf(scale)];
    taken = taken ? kFreshShare * ms + (1.0 - kFreshShare) * *taken : ms;
    const std::size_t now = stepOf(scale_);
    const double leastMs = predictedMs(kScales.size() - 1);
    for (std::size_t step = 0; step < kScales.size(); ++step) {
        const double allowedMs = std::max(step < now ? kRoom * targetMs_ : targetMs_, kWorthwhile * leastMs);
        if (predictedMs(step) > allowedMs && step + 1 < kScales.size()) continue;
        scale_ = kScales[step];
        return;
    }
}

void ResolutionScale::restart(double guess) {
    scale_ = kScales[stepOf(guess)];
    takenMs_ = {};
}

} // namespace tessera::viewer
