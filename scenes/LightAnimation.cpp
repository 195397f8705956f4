#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "scenes/Scene.h"

namespace tessera::scenes {
namespace {

/// The share of the period that has passed, 0 <= share < 1: taken before any trigonometry, so that late times stay
/// exact.
double periodShare(const LightAnimation& animation, double timeSeconds) {
    const double turns = timeSeconds / animation.periodSeconds + animation.phase;
    return turns - std::floor(turns);
}

/// Rodrigues' rotation formula.
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& unitAxis, double angleRadians) {
    const double c = std::cos(angleRadians);
    const double s = std::sin(angleRadians);
    return vector * c + glm::cross(unitAxis, vector) * s + unitAxis * (glm::dot(unitAxis, vector) * (1.0 - c));
}

glm::dvec3 alongClosedPolyline(const std::vector<glm::dvec3>& pointsWS, double share) {
    double lengthMetres = 0.0;
    for (std::size_t i = 0; i < pointsWS.size(); ++i) {
        lengthMetres += glm::distance(pointsWS[i], pointsWS[(i + 1) % pointsWS.size()]);
    }
    double leftMetres = share * lengthMetres;
    for (std::size_t i = 0; i < pointsWS.size(); ++i) {
        const glm::dvec3& from = pointsWS[i];
        const glm::dvec3& to = pointsWS[(i + 1) % pointsWS.size()];
        const double sideMetres = glm::distance(from, to);
        if (leftMetres < sideMetres) return glm::mix(from, to, leftMetres / sideMetres);
        leftMetres -= sideMetres;
    }
    return pointsWS.front();
}

glm::dvec3 betweenKeyframes(const LightAnimation& animation, double timeSeconds) {
    const std::vector<double>& times = animation.timesSeconds;
    const auto next = std::upper_bound(times.begin(), times.end(), timeSeconds);
    if (next == times.begin()) return animation.pointsWS.front();
    if (next == times.end()) return animation.pointsWS.back();
    const auto i = static_cast<std::size_t>(next - times.begin());
    const double share = (timeSeconds - times[i - 1]) / (times[i] - times[i - 1]);
    return glm::mix(animation.pointsWS[i - 1], animation.pointsWS[i], share);
}

} // namespace

Light lightAtTime(const Light& light, double timeSeconds) {
    assert(std::isfinite(timeSeconds));
    if (!light.animation || !infoOf(light.type).hasPosition()) return light;
    const LightAnimation& animation = *light.animation;
    Light moved = light;
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
        moved.positionWS = alongClosedPolyline(animation.pointsWS, periodShare(animation, timeSeconds));
        break;
    case LightAnimationKind::Keyframes:
        moved.positionWS = betweenKeyframes(animation, timeSeconds);
        break;
    }
    return moved;
}

} // namespace tessera::scenes
