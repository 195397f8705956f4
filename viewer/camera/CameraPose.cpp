#include "viewer/camera/CameraPose.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scenes/Limits.h"
#include "scenes/LookAt.h"

namespace tessera::viewer {
namespace {

/// Zooming in moves the near plane closer, so that it does not cut into surfaces: it keeps its fraction of the focus
/// distance, or this one if it began smaller. At the initial focus, a scene's near plane stays where it is: it may cut
/// a wall away. With reversed floating-point depth, a close near plane costs no precision.
constexpr double kNearShare = 0.01;

double nearMetresOf(const CameraPose& pose) {
    if (pose.focusMetres >= pose.nearFocusMetres) return pose.nearMetres;
    const double share = std::max(pose.nearMetres / pose.nearFocusMetres, kNearShare);
    return std::min(pose.nearMetres, std::max(share * pose.focusMetres, scenes::kNearestPlaneMetres));
}

double focusOf(const scenes::Camera& camera, const scenes::Box3& boundsWS) {
    if (boundsWS.empty()) return 1.0;
    const double diagonalMetres = glm::length(boundsWS.max - boundsWS.min);
    const glm::dvec3 centerWS = 0.5 * (boundsWS.min + boundsWS.max);
    const glm::dvec3 forwardWS = headingOf(glm::dmat3(camera.worldFromCamera)).forwardWS();
    const double depthMetres = glm::dot(centerWS - glm::dvec3(camera.worldFromCamera[3]), forwardWS);
    // Closer than this, the centre lies beside the eye rather than ahead.
    constexpr double kLeastShare = 0.05;
    if (depthMetres > kLeastShare * diagonalMetres) return depthMetres;
    return diagonalMetres > 0.0 ? 0.5 * diagonalMetres : 1.0;
}

} // namespace

CameraPose poseOf(const scenes::Camera& camera, const scenes::Box3& boundsWS) {
    return poseOf(camera, focusOf(camera, boundsWS));
}

CameraPose poseOf(const scenes::Camera& camera, double focusMetres) {
    assert(focusMetres > 0.0);
    CameraPose pose;
    pose.eyeWS = glm::dvec3(camera.worldFromCamera[3]);
    pose.heading = headingOf(glm::dmat3(camera.worldFromCamera));
    pose.focusMetres = pose.nearFocusMetres = focusMetres;
    pose.halfHeightMetres = camera.halfHeightMetres;
    pose.nearMetres = camera.nearMetres;
    pose.farMetres = camera.farMetres;
    return pose;
}

CameraPose between(const CameraPose& pose, const glm::dvec3& eyeWS, const glm::dvec3& targetWS) {
    CameraPose moved = pose;
    const double distanceMetres = glm::distance(eyeWS, targetWS);
    if (!(distanceMetres > 0.0)) return moved;
    moved.eyeWS = eyeWS;
    moved.focusMetres = distanceMetres;
    moved.heading = headingOf(glm::dmat3(scenes::worldFromLookAt(eyeWS, targetWS)));
    moved.heading.rollRadians += pose.heading.rollRadians;
    return moved;
}

glm::dvec3 targetOf(const CameraPose& pose) {
    return pose.eyeWS + pose.focusMetres * pose.heading.forwardWS();
}

scenes::CameraChange changeOf(const CameraPose& pose, const scenes::Camera& start) {
    assert(pose.focusMetres > 0.0);
    scenes::CameraChange change;
    change.eyeWS = pose.eyeWS;
    change.targetWS = pose.eyeWS + pose.focusMetres * pose.heading.forwardWS();
    // Far from the origin, a short focus distance is lost in the rounding of the eye.
    if (*change.targetWS == pose.eyeWS) *change.targetWS += glm::length(pose.eyeWS) * pose.heading.forwardWS();
    const bool isUpright = pose.heading.rollRadians == 0.0 && std::abs(pose.heading.pitchRadians) <= kMostPitchRadians;
    if (!isUpright) change.upWS = pose.heading.upWS();
    double nearMetres = pose.nearMetres;
    if (start.projection == scenes::Projection::Perspective)
        nearMetres = nearMetresOf(pose);
    else if (pose.halfHeightMetres != start.halfHeightMetres)
        change.halfHeightMetres = pose.halfHeightMetres;
    if (nearMetres != start.nearMetres) change.nearMetres = nearMetres;
    if (pose.farMetres != start.farMetres) change.farMetres = pose.farMetres;
    return change;
}

scenes::Camera cameraAt(const CameraPose& pose, const scenes::Camera& start) {
    return scenes::changedCamera(start, changeOf(pose, start));
}

double metresPerPixel(const scenes::Camera& lens, const CameraPose& pose, double depthMetres, double heightPixels) {
    const bool isPerspective = lens.projection == scenes::Projection::Perspective;
    const double halfHeightMetres =
        isPerspective ? depthMetres * std::tan(0.5 * lens.fovYRadians) : pose.halfHeightMetres;
    return 2.0 * halfHeightMetres / heightPixels;
}

} // namespace tessera::viewer
