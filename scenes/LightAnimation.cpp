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

/// Fractional part of a number of turns; 0 if it is not finite.
double shareOf(double turns) {
    return std::isfinite(turns) ? turns - std::floor(turns) : 0.0;
}

/// The fraction of the period that has passed, 0 <= share < 1: reduced before any trigonometry, so that late times stay
/// exact.
double periodShare(const LightAnimation& animation, double timeSeconds) {
    return shareOf(timeSeconds / animation.periodSeconds + animation.phase);
}

/// Rodrigues' rotation formula.
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& unitAxis, double angleRadians) {
    const double c = std::cos(angleRadians);
    const double s = std::sin(angleRadians);
    return vector * c + glm::cross(unitAxis, vector) * s + unitAxis * (glm::dot(unitAxis, vector) * (1.0 - c));
}

/// The segment of a path between two consecutive points.
struct PathSide {
    glm::dvec3 fromWS, toWS;
    glm::dvec3 fromSlopeWS, toSlopeWS; ///< derivative by the fraction of the segment
    PathLine line;

    glm::dvec3 placeAt(double share) const {
        if (line == PathLine::Straight) return glm::mix(fromWS, toWS, share);
        const std::array<double, 4> weights = splineWeights(share, 1.0);
        return weights[0] * fromWS + weights[1] * fromSlopeWS + weights[2] * toWS + weights[3] * toSlopeWS;
    }
    /// Tangent towards the end point, of any length.
    glm::dvec3 tangentAt(double share) const {
        if (line == PathLine::Straight) return toWS - fromWS;
        const std::array<double, 4> weights = splineSlopeWeights(share);
        return weights[0] * fromWS + weights[1] * fromSlopeWS + weights[2] * toWS + weights[3] * toSlopeWS;
    }
};

/// Centripetal parameterisation: the time between two points is the square root of their distance, which avoids loops
/// and cusps. Source: Yuksel, Schaefer and Keyser 2011, "Parameterization and Applications of Catmull-Rom Curves".
double centripetalTime(const glm::dvec3& fromWS, const glm::dvec3& toWS) {
    return std::sqrt(glm::distance(fromWS, toWS));
}

/// Velocity by that time at the middle of three points. Coincident points count once.
glm::dvec3 velocityAt(const glm::dvec3& beforeWS, const glm::dvec3& hereWS, const glm::dvec3& afterWS) {
    const double before = centripetalTime(beforeWS, hereWS), after = centripetalTime(hereWS, afterWS);
    if (!(before > 0.0)) return after > 0.0 ? (afterWS - hereWS) / after : glm::dvec3(0.0);
    if (!(after > 0.0)) return (hereWS - beforeWS) / before;
    return (hereWS - beforeWS) / before - (afterWS - beforeWS) / (before + after) + (afterWS - hereWS) / after;
}

/// Segment `i` of a path. Open paths are extended beyond their ends by reflection.
PathSide sideOf(const LightAnimation& path, std::size_t i) {
    const std::vector<glm::dvec3>& pointsWS = path.pointsWS;
    const std::size_t count = pointsWS.size();
    PathSide side{pointsWS[i], pointsWS[(i + 1) % count], {}, {}, path.line};
    if (path.line == PathLine::Straight) return side;
    const bool isFirst = path.isOpen && i == 0, isLast = path.isOpen && i + 2 == count;
    const glm::dvec3 beforeWS = isFirst ? 2.0 * side.fromWS - side.toWS : pointsWS[(i + count - 1) % count];
    const glm::dvec3 afterWS = isLast ? 2.0 * side.toWS - side.fromWS : pointsWS[(i + 2) % count];
    const double time = centripetalTime(side.fromWS, side.toWS);
    side.fromSlopeWS = time * velocityAt(beforeWS, side.fromWS, side.toWS);
    side.toSlopeWS = time * velocityAt(side.fromWS, side.toWS, afterWS);
    return side;
}

struct OnPath {
    glm::dvec3 placeWS;
    glm::dvec3 aheadWS; ///< of any length
};

/// Open paths run there and back. Speed is constant along chords; curved segments have many.
OnPath alongPath(const LightAnimation& path, double share) {
    const std::size_t sides = path.pointsWS.size() - (path.isOpen ? 1 : 0);
    const std::size_t chords = path.line == PathLine::Straight ? 1 : 64;
    std::vector<double> endMetres; // cumulative length, by chord
    double lengthMetres = 0.0;
    for (std::size_t i = 0; i < sides; ++i) {
        const PathSide side = sideOf(path, i);
        glm::dvec3 fromWS = side.fromWS;
        for (std::size_t k = 1; k <= chords; ++k) {
            const glm::dvec3 toWS = side.placeAt(double(k) / double(chords));
            lengthMetres += glm::distance(fromWS, toWS);
            endMetres.push_back(lengthMetres);
            fromWS = toWS;
        }
    }
    const bool isBackward = path.isOpen && share >= 0.5;
    const double metres = (path.isOpen ? 1.0 - std::abs(1.0 - 2.0 * share) : share) * lengthMetres;
    const auto next = std::ranges::upper_bound(endMetres, metres);
    const auto chord = std::min(std::size_t(next - endMetres.begin()), endMetres.size() - 1);
    const double startMetres = chord == 0 ? 0.0 : endMetres[chord - 1];
    const double ofChord = next == endMetres.end() ? 1.0 : (metres - startMetres) / (endMetres[chord] - startMetres);
    const PathSide side = sideOf(path, chord / chords);
    const double ofSide = (double(chord % chords) + ofChord) / double(chords);
    const glm::dvec3 onwardWS = directionOf(side.tangentAt(ofSide)).value_or(side.toWS - side.fromWS);
    return {side.placeAt(ofSide), isBackward ? -onwardWS : onwardWS};
}

/// Maps a time into the range of the keys, according to KeyRepeat.
double withinKeys(const LightKeys& keys, double timeSeconds) {
    const double first = keys.timesSeconds.front();
    const double length = keys.timesSeconds.back() - first;
    if (keys.repeat == KeyRepeat::Once || length <= 0.0) return timeSeconds;
    const double turns = (timeSeconds - first) / length;
    const double share = shareOf(turns);
    const bool isBackward = keys.repeat == KeyRepeat::PingPong && shareOf(0.5 * turns) >= 0.5;
    return first + (isBackward ? 1.0 - share : share) * length;
}

/// Interpolates unit vectors along the shorter great circle at constant speed; for opposite ones along a fixed one.
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
        return isOnSphere ? directionOf(value).value_or(from) : value; // a spline through zero has no direction
    }
    case Interpolation::Linear:
        break;
    }
    return isOnSphere ? alongGreatCircle(from, to, share) : glm::mix(from, to, share);
}

/// Applies an animation to a light in its rest state.
void animate(Light& light, const LightAnimation& animation, double timeSeconds) {
    switch (animation.kind) {
    case LightAnimationKind::Orbit: {
        const double angleRadians = 2.0 * std::numbers::pi * periodShare(animation, timeSeconds);
        const glm::dvec3 armMetres = light.positionWS - animation.centerWS;
        light.positionWS = animation.centerWS + rotated(armMetres, glm::normalize(animation.axisWS), angleRadians);
        break;
    }
    case LightAnimationKind::Wobble:
        light.positionWS +=
            animation.amplitudeMetres * std::sin(2.0 * std::numbers::pi * periodShare(animation, timeSeconds));
        break;
    case LightAnimationKind::Path: {
        const OnPath onPath = alongPath(animation, periodShare(animation, timeSeconds));
        light.positionWS = onPath.placeWS;
        if (animation.looksAhead && infoOf(light.type).hasDirection)
            light.directionWS = directionOf(onPath.aheadWS).value_or(light.directionWS);
        break;
    }
    case LightAnimationKind::Keyframes:
        light.positionWS = betweenKeys(animation.keys, timeSeconds);
        break;
    }
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
    // Coprime, so that the sum repeats late; the last one is the frequency itself.
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

bool hasLength(const LightAnimation& path) {
    const std::vector<glm::dvec3>& pointsWS = path.pointsWS;
    return std::ranges::any_of(pointsWS, [&](const glm::dvec3& pointWS) { return pointWS != pointsWS.front(); });
}

bool hasKeys(const Light& light, LightKeyed of) {
    return std::ranges::find(light.keyframes, of, &LightKeys::of) != light.keyframes.end();
}

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

Light lightAtTime(const Light& light, double timeSeconds) {
    assert(std::isfinite(timeSeconds));
    const LightTypeInfo& type = infoOf(light.type);
    Light moved = light;
    for (const LightKeys& keys : light.keyframes)
        if (infoOf(keys.of).isOf(type)) setKeyed(moved, keys.of, betweenKeys(keys, timeSeconds));
    if (light.flicker) moved.intensity = float(double(moved.intensity) * flickerAt(*light.flicker, timeSeconds));
    if (light.animation && type.hasPosition()) animate(moved, *light.animation, timeSeconds);
    if (moved.directionWS != light.directionWS && type.isTurned())
        moved.alongWS = acrossFrom(moved.directionWS, light.alongWS).value_or(usualAlong(moved.directionWS));
    return moved;
}

} // namespace tessera::scenes
