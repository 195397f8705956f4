#include "viewer/camera/FlyCamera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viewer/camera/Damping.h"
#include "viewer/camera/Turns.h"

namespace tessera::viewer {
namespace {

constexpr double kDiagonalSeconds = 8.0; ///< to cross the bounds' diagonal: a stroll
constexpr double kFastFactor = 5.0;
constexpr double kStepsToDouble = 2.0; ///< steps that double the speed
constexpr double kMostSpeedSteps = 8.0;

double speedIn(const scenes::Box3& boundsWS) {
    const double diagonalMetres = boundsWS.empty() ? 0.0 : glm::length(boundsWS.max - boundsWS.min);
    return (diagonalMetres > 0.0 ? diagonalMetres : 1.0) / kDiagonalSeconds;
}

} // namespace

FlyCamera::FlyCamera(const CameraPose& pose, const scenes::Camera& lens, const scenes::Box3& boundsWS)
    : lens_(lens), usualMetresPerSecond_(speedIn(boundsWS)), shown_(pose), goal_(pose) {}

void FlyCamera::look(const glm::dvec2& movePixels, double heightPixels) {
    // Parallel rays turn like a perspective camera with the same view height at the focus.
    const double tanPerPixel = metresPerPixel(lens_, goal_, goal_.focusMetres, heightPixels) / goal_.focusMetres;
    goal_.heading = turned(goal_.heading, -movePixels.x * tanPerPixel, -movePixels.y * tanPerPixel);
}

void FlyCamera::changeSpeed(double steps) {
    speedSteps_ = std::clamp(speedSteps_ + steps, -kMostSpeedSteps, kMostSpeedSteps);
}

double FlyCamera::metresPerSecond() const {
    return usualMetresPerSecond_ * std::exp2(speedSteps_ / kStepsToDouble);
}

glm::dvec3 FlyCamera::velocityWS() const {
    const auto axis = [](bool positive, bool negative) { return double(positive) - double(negative); };
    const glm::dvec3 directionWS = axis(keys_.forward, keys_.back) * goal_.heading.forwardWS() +
                                   axis(keys_.right, keys_.left) * goal_.heading.rightWS() +
                                   axis(keys_.up, keys_.down) * glm::dvec3(0.0, 1.0, 0.0);
    const double length = glm::length(directionWS);
    // Looking straight down, forward and up may cancel up to rounding.
    constexpr double kLeastLength = 1e-6;
    if (length < kLeastLength) return glm::dvec3(0.0);
    return directionWS / length * metresPerSecond() * (keys_.fast ? kFastFactor : 1.0);
}

void FlyCamera::goTo(const CameraPose& pose) {
    goal_ = pose;
    shown_.heading = nearestTurn(shown_.heading, goal_.heading);
}

void FlyCamera::jumpTo(const CameraPose& pose) {
    shown_ = goal_ = pose;
}

double FlyCamera::pixelsToGoal(double heightPixels) const {
    const double metres = metresPerPixel(lens_, shown_, shown_.focusMetres, heightPixels);
    const double scale = std::max(std::abs(goal_.focusMetres / shown_.focusMetres - 1.0),
                                  std::abs(goal_.halfHeightMetres / shown_.halfHeightMetres - 1.0));
    return (glm::distance(shown_.eyeWS, goal_.eyeWS) +
            turnBetween(shown_.heading, goal_.heading) * shown_.focusMetres) /
               metres +
           scale * heightPixels;
}

void FlyCamera::advance(double stepSeconds, double heightPixels) {
    assert(stepSeconds >= 0.0);
    const glm::dvec3 velocity = velocityWS();
    goal_.eyeWS += velocity * stepSeconds;
    shown_.eyeWS = dampedBehind(shown_.eyeWS, goal_.eyeWS, velocity, stepSeconds);
    const double share = dampingShare(stepSeconds);
    const auto approach = [share](double& from, double to) { from += (to - from) * share; };
    approach(shown_.heading.yawRadians, goal_.heading.yawRadians);
    approach(shown_.heading.pitchRadians, goal_.heading.pitchRadians);
    approach(shown_.heading.rollRadians, goal_.heading.rollRadians);
    approach(shown_.focusMetres, goal_.focusMetres);
    approach(shown_.halfHeightMetres, goal_.halfHeightMetres);
    shown_.nearMetres = goal_.nearMetres;
    shown_.nearFocusMetres = goal_.nearFocusMetres;
    shown_.farMetres = goal_.farMetres;
    if (velocity == glm::dvec3(0.0) && pixelsToGoal(heightPixels) < kRestPixels) shown_ = goal_;
}

bool FlyCamera::isAtRest() const {
    return velocityWS() == glm::dvec3(0.0) && shown_ == goal_;
}

} // namespace tessera::viewer
