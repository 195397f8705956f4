#include "viewer/show/ResolutionScale.h"

#include <algorithm>
#include <cmath>

namespace tessera::viewer {
namespace {

/// Weight of the latest image's time, against earlier ones.
constexpr double kFreshShare = 0.5;
/// A larger image must be predicted to take less than this fraction of the target, so that the scale does not flicker.
constexpr double kRoom = 0.85;
/// Least speed-up that justifies a smaller image.
constexpr double kWorthwhile = 1.15;
/// Number of images after which the time at another scale is forgotten, because the scene and the machine's load
/// change.
constexpr int kOldest = 30;
constexpr int kPicturesBelieved = 2;

std::size_t stepOf(double scale) {
    std::size_t step = 0;
    while (step + 1 < kScales.size() && kScales[step] > scale * 1.001) ++step;
    return step;
}

double pixelsOf(std::size_t step) {
    return kScales[step] * kScales[step];
}

} // namespace

/// The line of least relative error through the measured times; neither of its coefficients is negative.
ResolutionScale::Cost ResolutionScale::cost() const {
    double weights = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t step = 0; step < kScales.size(); ++step) {
        if (!samples_[step]) continue;
        const double weight = 1.0 / std::max(samples_[step]->ms * samples_[step]->ms, 1e-6);
        weights += weight;
        x += weight * pixelsOf(step);
        y += weight * samples_[step]->ms;
        xx += weight * pixelsOf(step) * pixelsOf(step);
        xy += weight * pixelsOf(step) * samples_[step]->ms;
    }
    if (weights == 0.0) return {};
    const double spread = weights * xx - x * x;
    if (spread <= 1e-9 * weights * xx) return {0.0, xy / xx}; // a single scale: assumes that only pixels cost
    const double wholeMs = std::max((weights * xy - x * y) / spread, 0.0);
    const double frameMs = (y - wholeMs * x) / weights;
    if (frameMs >= 0.0) return {frameMs, wholeMs};
    return {0.0, xy / xx};
}

double ResolutionScale::predictedMsOf(std::size_t step) const {
    if (samples_[step]) return samples_[step]->ms;
    const Cost known = cost();
    return known.frameMs + known.wholeMs * pixelsOf(step);
}

double ResolutionScale::predictedMs(double scale) const {
    return predictedMsOf(stepOf(scale));
}

void ResolutionScale::drew(double scale, double ms) {
    for (std::optional<Sample>& sample : samples_)
        if (sample && ++sample->age > kOldest) sample.reset();
    std::optional<Sample>& taken = samples_[stepOf(scale)];
    if (!taken)
        taken = Sample{ms, ms, 1, 0};
    else
        taken = Sample{kFreshShare * ms + (1.0 - kFreshShare) * taken->ms, std::min(ms, taken->leastMs),
                       taken->count + 1, 0};
    // A smaller image takes no longer: a longer time is outdated, or included work such as shadow maps.
    for (std::size_t smaller = stepOf(scale) + 1; smaller < kScales.size(); ++smaller)
        if (samples_[smaller] && samples_[smaller]->leastMs > kWorthwhile * ms) samples_[smaller].reset();
    const std::size_t now = stepOf(scale_);
    const std::size_t last = kScales.size() - 1;
    // The gain of smaller images is known only when the smallest was drawn, and not by a single one: it may have
    // computed results that later ones reuse, such as shadow maps.
    const bool isKnown = samples_[last] && samples_[last]->count >= kPicturesBelieved;
    const double enoughMs = isKnown ? kWorthwhile * samples_[last]->leastMs : 0.0;
    std::size_t step = 0;
    const auto isTooSlow = [&](std::size_t tried) {
        return predictedMsOf(tried) > std::max(tried < now ? kRoom * targetMs_ : targetMs_, enoughMs);
    };
    while (step < last && isTooSlow(step)) ++step;
    scale_ = kScales[step];
}

void ResolutionScale::restart(double guess) {
    scale_ = kScales[stepOf(guess)];
    samples_ = {};
}

} // namespace tessera::viewer
