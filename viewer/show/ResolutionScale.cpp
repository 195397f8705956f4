#include "viewer/show/ResolutionScale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::viewer {
namespace {

constexpr std::array kScales{1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125, 0.09375, 0.0625};
/// Larger pictures are only taken after some that would have allowed it, so that the scale does not flicker.
constexpr int kQuickFrames = 3;
/// A larger picture must fit by prediction with this much room.
constexpr double kRoom = 0.85;

/// The largest step not above `wanted`.
double stepBelow(double wanted) {
    for (const double scale : kScales)
        if (scale <= wanted) return scale;
    return kScales.back();
}

double stepAbove(double scale) {
    double above = kScales.front();
    for (const double step : kScales)
        if (step > scale) above = step;
    return above;
}

} // namespace

void ResolutionScale::drew(double scale, double ms) {
    // Time goes with the pixels at most; what does not, makes the prediction for smaller pictures too hopeful and for
    // larger ones too careful, and the next frames correct it.
    const double msPerWhole = ms / (scale * scale);
    if (ms > targetMs_) {
        quickFrames_ = 0;
        const double wanted = stepBelow(std::sqrt(targetMs_ / msPerWhole));
        scale_ = std::min(wanted, scale <= scale_ ? stepBelow(scale * 0.999) : scale_);
        return;
    }
    if (scale < scale_) return; // drawn before a decision that already knows better
    const double larger = stepAbove(scale_);
    const bool fits = msPerWhole * larger * larger < kRoom * targetMs_;
    quickFrames_ = fits ? quickFrames_ + 1 : 0;
    if (quickFrames_ < kQuickFrames) return;
    scale_ = larger;
    quickFrames_ = 0;
}

void ResolutionScale::restart(double guess) {
    scale_ = stepBelow(guess);
    quickFrames_ = 0;
}

} // namespace tessera::viewer
