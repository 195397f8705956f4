#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <variant>

#include "scenes/AreaLight.h"
#include "scenes/Direction.h"
#include "scenes/Scene.h"

namespace tessera::scenes {
namespace {

/// The share of the period that has passed, 0 <= share < 1: taken before any trigonometry, so that late times stay
/// exact.
/// What is left of whole turns: of more turns than a double can count nothing is.
double shareOf(double turns) {
    return std::isfinite(turns) ? turns - std::floor(turns) : 0.0;
}

double periodShare(const LightAnimation& animation, double timeSeconds) {
    return shareOf(timeSeconds / animation.periodSeconds + animation.phase);
}

/// Rodrigues' rotation formula.
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& unitAxis, double angleRadians) {
    const double c = std::cos(angleRadians);
    const double s = std::sin(angleRadians);
    return vector * c + glm::cross(unitAxis, vector) * s + unitAxis * (glm::dot(unitAxis, vector) * (1.0 - c));
}

/// An open line is run along there and back.
glm::dvec3 alongPolyline(const std::vector<glm::dvec3>& pointsWS, bool isOpen, double share) {
    const std::size_t sides = pointsWS.size() - (isOpen ? 1 : 0);
    double lengthMetres = 0.0;
    for (std::size_t i = 0; i < sides; ++i)
        lengthMetres += glm::distance(pointsWS[i], pointsWS[(i + 1) % pointsWS.size()]);
    double leftMetres = (isOpen ? 1.0 - std::abs(1.0 - 2.0 * share) : share) * lengthMetres;
    for (std::size_t i = 0; i < sides; ++i) {
        const glm::dvec3& from = pointsWS[i];
        const glm::dvec3& to = pointsWS[(i + 1) % pointsWS.size()];
        const double sideMetres = glm::distance(from, to);
        if (leftMetres < sideMetres) return glm::mix(from, to, leftMetres / sideMetres);
        leftMetres -= sideMetres;
    }
    return isOpen ? pointsWS.back() : pointsWS.front();
}

/// The time between the first key and the last at which all is as at `timeSeconds`.
double withinKeys(const LightKeys& keys, double timeSeconds) {
    const double first = keys.timesSeconds.front();
    const double length = keys.timesSeconds.back() - first;
    if (keys.repeat == KeyRepeat::Once || length <= 0.0) return timeSeconds;
    const double turns = (timeSeconds - first) / length;
    const double share = shareOf(turns);
    const bool isBackward = keys.repeat == KeyRepeat::PingPong && shareOf(0.5 * turns) >= 0.5;
    return first + (isBackward ? 1.0 - share : share) * length;
}

/// Between unit vectors the shortest way at constant speed; between opposite ones any way, always the same.
glm::dvec3 alongGreatCircle(const glm::dvec3& from, const glm::dvec3& to, double share) {
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal), cosine = glm::dot(from, to);
    if (sine > 1e-12) return rotated(from, normal / sine, share * std::atan2(sine, cosine));
    return cosine < 0.0 ? rotated(from, usualAlong(from), share * std::numbers::pi) : from;
}

glm::dvec3 betweenKeys(const LightKeys& keys, double anyTimeSeconds) {
    const std::vector<double>& times = keys.timesSeconds;
    const double timeSeconds = withinKeys(keys, anyTimeSeconds);
    const auto next = std::upper_bound(times.begin(), times.end(), timeSeconds);
    if (next == times.begin()) return keys.values.front();
    if (next == times.end()) return keys.values.back();
    const auto i = static_cast<std::size_t>(next - times.begin());
    const glm::dvec3 &from = keys.values[i - 1], &to = keys.values[i];
    const double seconds = times[i] - times[i - 1];
    const double share = (timeSeconds - times[i - 1]) / seconds;
    const bool isOnSphere = infoOf(keys.of).isOnSphere;
    switch (keys.interpolation) {
    case Interpolation::Step:
        return from;
    case Interpolation::CubicSpline: {
        const std::array<double, 4> weights = splineWeights(share, seconds);
        const glm::dvec3 value = weights[0] * from + weights[1] * keys.outTangents[i - 1] + weights[2] * to +
                                 weights[3] * keys.inTangents[i];
        return isOnSphere ? directionOf(value).value_or(from) : value; // through the middle there is no direction
    }
    case Interpolation::Linear:
        break;
    }
    return isOnSphere ? alongGreatCircle(from, to, share) : glm::mix(from, to, share);
}

/// Splines go past their keys: a member with bounds stays within them.
void setKeyed(Light& light, LightKeyed member, const glm::dvec3& value) {
    std::visit(
        [&](auto at) {
            const auto field = fieldOf(kLightFields, at);
            auto& own = light.*at;
            if constexpr (std::is_same_v<std::decay_t<decltype(own)>, float>)
                own = float(std::clamp(value.x, field.least, field.most));
            else if constexpr (std::is_same_v<std::decay_t<decltype(own)>, glm::vec3>)
                own = glm::vec3(glm::clamp(value, field.least, field.most));
            else
                own = value;
        },
        infoOf(member).at);
}

/// Source: Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators" (SplitMix64). 0 <= share < 1.
double hashedShare(std::uint64_t number) {
    std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
    return std::ldexp(double((z ^ (z >> 31u)) >> 11u), -53);
}

} // namespace

double flickerAt(const LightFlicker& flicker, double timeSeconds) {
    // Without common divisors, so that the whole repeats late; the last is the frequency itself.
    constexpr std::array kHarmonics{17.0, 29.0, 43.0, 64.0};
    const double share = shareOf(timeSeconds * (flicker.frequencyHz / kHarmonics.back()));
    double sum = 0.0;
    for (std::size_t i = 0; i < kHarmonics.size(); ++i) {
        const double phase = hashedShare(std::uint64_t(flicker.seed) * kHarmonics.size() + i);
        sum += std::sin(2.0 * std::numbers::pi * (kHarmonics[i] * share + phase));
    }
    return 1.0 + flicker.amplitude / double(kHarmonics.size()) * sum;
}

bool movesByItself(const Light& light) {
    return light.animation || light.flicker || !light.keyframes.empty();
}

Light lightAtTime(const Light& light, double timeSeconds) {
    assert(std::isfinite(timeSeconds));
    Light moved = light;
    for (const LightKeys& keys : light.keyframes)
        if (infoOf(keys.of).isOf(infoOf(light.type))) setKeyed(moved, keys.of, betweenKeys(keys, timeSeconds));
    if (moved.directionWS != light.directionWS && infoOf(light.type).isTurned())
        moved.alongWS = acrossFrom(moved.directionWS, light.alongWS).value_or(usualAlong(moved.directionWS));
    if (light.flicker) moved.intensity = float(double(moved.intensity) * flickerAt(*light.flicker, timeSeconds));
    if (!light.animation || !infoOf(light.type).hasPosition()) return moved;
    const LightAnimation& animation = *light.animation;
    switch (animation.kind) {
    case LightAnimationKind::Orbit: {
        const double angleRadians = 2.0 * std::numbers::pi * periodShare(animation, timeSeconds);
        const glm::dvec3 armMetres = light.positionWS - animation.centerWS;
        moved.positionWS = animation.centerWS + rotated(armMetres, glm::normalize(animation.axisWS), angleRadians);
        break;
    }
    case LightAnimationKind::Wobble:
        moved.positionWS +=
            animation.amplitudeMetres * std::sin(2.0 * std::numbers::pi * periodShare(animation, timeSeconds));
        break;
    case LightAnimationKind::Path:
        moved.positionWS = alongPolyline(animation.pointsWS, animation.isOpen, periodShare(animation, timeSeconds));
        break;
    case LightAnimationKind::Keyframes:
        moved.positionWS = betweenKeys(animation.keys, timeSeconds);
        break;
    }
    return moved;
}

} // namespace tessera::scenes
