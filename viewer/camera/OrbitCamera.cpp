#include "viewer/camera/OrbitCamera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viewer/camera/Damping.h"
#include "viewer/camera/Turns.h"

namespace tessera::viewer {
namespace {

/// Zooming ends before distances exceed the precision of double and of the GPU's single precision.
constexpr double kNearestMetres = 1e-6;
constexpr double kFarthestMetres = 1e9;

/// Radians per pixel so that a ball about the pivot turns under the cursor. Its radius is a quarter of the image height
/// at the pivot, and at most half the distance, so that the eye stays outside.
double turnPerPixel(const scenes::Camera& lens, double heightPixels) {
    if (lens.projection == scenes::Projection::Orthographic) return 4.0 / heightPixels;
    const double tanHalf = std::tan(0.5 * lens.fovYRadians);
    const double radius = std::min(0.5 * tanHalf, 0.5); // relative to the distance
    return 2.0 * tanHalf * (1.0 - radius) / (radius * heightPixels);
}

} // namespace

OrbitCamera::OrbitCamera(const CameraPose& pose, const scenes::Camera& lens) : lens_(lens) {
    jumpTo(pose);
}

OrbitCamera::State OrbitCamera::stateOf(const CameraPose& pose) {
    assert(pose.focusMetres > 0.0);
    return {pose.eyeWS + pose.focusMetres * pose.heading.forwardWS(), pose};
}

/// Zero movements keep the goal bit-identical.
void OrbitCamera::changeGoal(State goal) {
    if (goal == goal_) return;
    goal.placeEye();
    goal_ = goal;
}

void OrbitCamera::rotate(const glm::dvec2& dragPixels, double heightPixels) {
    const glm::dvec2 angles = dragPixels * turnPerPixel(lens_, heightPixels);
    // Dragging the front to the right moves the eye to the left, and turns the view to the right.
    State goal = goal_;
    goal.pose.heading = turned(goal.pose.heading, -angles.x, -angles.y);
    changeGoal(goal);
}

void OrbitCamera::pan(const glm::dvec2& dragPixels, double heightPixels) {
    const CameraPose& pose = goal_.pose;
    const double metres = metresPerPixel(lens_, pose, pose.focusMetres, heightPixels);
    State goal = goal_;
    goal.pivotWS += metres * (dragPixels.y * pose.heading.upWS() - dragPixels.x * pose.heading.rightWS());
    changeGoal(goal);
}

void OrbitCamera::zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels) {
    assert(factor > 0.0);
    State goal = goal_;
    CameraPose& pose = goal.pose;
    const double metres = metresPerPixel(lens_, pose, pose.focusMetres, heightPixels);
    const bool isPerspective = lens_.projection == scenes::Projection::Perspective;
    double& scaled = isPerspective ? pose.focusMetres : pose.halfHeightMetres;
    const double before = scaled;
    scaled = std::clamp(before * factor, std::min(before, kNearestMetres), std::max(before, kFarthestMetres));
    const glm::dvec3 cursorFromPivotWS =
        metres * (cursorFromCenterPixels.x * pose.heading.rightWS() - cursorFromCenterPixels.y * pose.heading.upWS());
    goal.pivotWS += (1.0 - scaled / before) * cursorFromPivotWS;
    changeGoal(goal);
}

void OrbitCamera::goTo(const CameraPose& pose) {
    goal_ = stateOf(pose);
    shown_.pose.heading = nearestTurn(shown_.pose.heading, goal_.pose.heading);
}

void OrbitCamera::jumpTo(const CameraPose& pose) {
    shown_ = goal_ = stateOf(pose);
}

/// Upper bound of the remaining movement in pixels at the pivot's depth.
double OrbitCamera::pixelsToGoal(double heightPixels) const {
    const CameraPose& from = shown_.pose;
    const CameraPose& to = goal_.pose;
    const double metres = metresPerPixel(lens_, from, from.focusMetres, heightPixels);
    const double scale = std::max(std::abs(to.focusMetres / from.focusMetres - 1.0),
                                  std::abs(to.halfHeightMetres / from.halfHeightMetres - 1.0));
    return glm::distance(shown_.pivotWS, goal_.pivotWS) / metres +
           (turnBetween(from.heading, to.heading) * from.focusMetres) / metres + scale * heightPixels;
}

void OrbitCamera::advance(double stepSeconds, double heightPixels) {
    assert(stepSeconds >= 0.0);
    const double share = dampingShare(stepSeconds);
    const auto approach = [share](auto& from, const auto& to) { from += (to - from) * share; };
    approach(shown_.pivotWS, goal_.pivotWS);
    CameraPose& from = shown_.pose;
    const CameraPose& to = goal_.pose;
    approach(from.heading.yawRadians, to.heading.yawRadians);
    approach(from.heading.pitchRadians, to.heading.pitchRadians);
    approach(from.heading.rollRadians, to.heading.rollRadians);
    approach(from.focusMetres, to.focusMetres);
    approach(from.halfHeightMetres, to.halfHeightMetres);
    from.nearMetres = to.nearMetres; // undamped: no visible change while all geometry lies between the planes
    from.nearFocusMetres = to.nearFocusMetres;
    from.farMetres = to.farMetres;
    shown_.placeEye();
    if (pixelsToGoal(heightPixels) < kRestPixels) shown_ = goal_;
}

} // namespace tessera::viewer
