#include "validation/figures/PixelErrors.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "validation/figures/Percentile.h"

namespace tessera::validation {
namespace {

PixelState stateOf(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded, std::size_t i) {
    if (!a.covered[i] && !b.covered[i]) return PixelState::Uncovered;
    if (!excluded.empty() && excluded[i]) return PixelState::Excluded;
    return isFinite(a.pixel(i)) && isFinite(b.pixel(i)) ? PixelState::Compared : PixelState::NotFinite;
}

double relativeError(const float* a, const float* b, double smallest) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double truth = double(b[c]);
        worst = std::max(worst, std::abs(double(a[c]) - truth) / std::max(std::abs(truth), smallest));
    }
    return worst;
}

} // namespace

bool isFinite(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

PixelErrors pixelErrors(const Picture& a, const Picture& b, std::span<const std::uint8_t> excluded) {
    assert(a.isConsistent() && b.isConsistent() && a.width == b.width && a.height == b.height);
    assert(excluded.empty() || excluded.size() == a.pixelCount());
    const std::size_t pixelCount = a.pixelCount();

    PixelErrors errors;
    errors.state.resize(pixelCount);
    errors.rel.assign(pixelCount, 0.0);
    std::vector<double> luminances;
    luminances.reserve(pixelCount);
    for (std::size_t i = 0; i < pixelCount; ++i) {
        errors.state[i] = stateOf(a, b, excluded, i);
        if (errors.state[i] == PixelState::Compared) luminances.push_back(std::abs(luminance(b.pixel(i))));
    }

    errors.litThreshold = 1e-4 * nearestRank(luminances, 990);
    std::erase_if(luminances, [&](double value) { return !(value > errors.litThreshold); });
    const double median = nearestRank(luminances, 500);
    errors.typicalLuminance = median > 1e-30 ? median : 1e-30;

    for (std::size_t i = 0; i < pixelCount; ++i)
        if (errors.state[i] == PixelState::Compared)
            errors.rel[i] = relativeError(a.pixel(i), b.pixel(i), 1e-3 * errors.typicalLuminance);
    return errors;
}

} // namespace tessera::validation
