#include "scenes/Animation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace tessera::scenes {
namespace {

void makeUnit(std::span<double> quaternion) {
    double largest = 0.0;
    for (const double number : quaternion) largest = std::max(largest, std::abs(number));
    if (!(largest > 0.0)) {
        std::ranges::fill(quaternion, 0.0);
        quaternion.back() = 1.0; // a spline through zero has no direction
        return;
    }
    double square = 0.0;
    for (double& number : quaternion) {
        number /= largest;
        square += number * number;
    }
    for (double& number : quaternion) number /= std::sqrt(square);
}

/// Value `which` of key `key` of a sampler.
std::span<const float> stored(const AnimationSampler& sampler, std::size_t key, std::size_t which) {
    const auto width = std::size_t(sampler.width);
    return std::span(sampler.values).subspan((key * sampler.valuesPerKey() + which) * width, width);
}

/// The value at a key.
void atKey(const AnimationSampler& sampler, bool isRotation, std::size_t key, std::span<double> value) {
    std::ranges::copy(stored(sampler, key, sampler.interpolation == Interpolation::CubicSpline ? 1 : 0), value.begin());
    if (isRotation) makeUnit(value);
}

/// Interpolates unit quaternions along the shorter arc at constant speed.
void slerp(std::span<double> from, std::span<const double> to, double share) {
    double dot = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) dot += from[i] * to[i];
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    // The half angle is computed from its tangent, which stays accurate near 0.
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        difference += (sign * to[i] - from[i]) * (sign * to[i] - from[i]);
        sum += (sign * to[i] + from[i]) * (sign * to[i] + from[i]);
    }
    const double angleRadians = 2.0 * std::atan2(std::sqrt(difference), std::sqrt(sum));
    const double sine = std::sin(angleRadians);
    double a = 1.0 - share, b = share;
    if (sine > 1e-12) { // for smaller angles arc and chord coincide
        a = std::sin((1.0 - share) * angleRadians) / sine;
        b = std::sin(share * angleRadians) / sine;
    }
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = a * from[i] + b * sign * to[i];
    makeUnit(from);
}

/// Source: glTF 2.0 specification, appendix C.5.
void spline(const AnimationSampler& sampler, std::size_t key, double share, double seconds, std::span<double> value) {
    const std::array<double, 4> weights = splineWeights(share, seconds);
    const std::span<const float> p0 = stored(sampler, key, 1), out = stored(sampler, key, 2);
    const std::span<const float> in = stored(sampler, key + 1, 0), p1 = stored(sampler, key + 1, 1);
    for (std::size_t i = 0; i < value.size(); ++i)
        value[i] = weights[0] * double(p0[i]) + weights[1] * double(out[i]) + weights[2] * double(p1[i]) +
                   weights[3] * double(in[i]);
}

} // namespace

double lengthSeconds(const Clip& clip) {
    double seconds = 0.0;
    for (const AnimationSampler& sampler : clip.samplers)
        seconds = std::max(seconds, double(sampler.timesSeconds.back()));
    return seconds;
}

void valueAt(const AnimationSampler& sampler, bool isRotation, double timeSeconds, std::span<double> value) {
    assert(std::isfinite(timeSeconds) && value.size() == std::size_t(sampler.width));
    const std::vector<float>& times = sampler.timesSeconds;
    const auto next = std::ranges::upper_bound(times, timeSeconds, {}, [](float time) { return double(time); });
    if (next == times.begin()) return atKey(sampler, isRotation, 0, value);
    const auto key = std::size_t(next - times.begin()) - 1;
    if (next == times.end()) return atKey(sampler, isRotation, key, value);
    const double seconds = double(times[key + 1]) - double(times[key]);
    const double share = (timeSeconds - double(times[key])) / seconds;
    switch (sampler.interpolation) {
    case Interpolation::Step:
        return atKey(sampler, isRotation, key, value);
    case Interpolation::CubicSpline:
        spline(sampler, key, share, seconds, value);
        if (isRotation) makeUnit(value);
        return;
    case Interpolation::Linear:
        break;
    }
    std::vector<double> to(value.size());
    atKey(sampler, isRotation, key, value);
    atKey(sampler, isRotation, key + 1, to);
    if (isRotation) return slerp(value, to, share);
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = (1.0 - share) * value[i] + share * to[i];
}

} // namespace tessera::scenes
