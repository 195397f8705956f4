#include "viewer/session/ShownCamera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/trigonometric.hpp>

#include "scenes/Framing.h"
#include "scenes/Load.h"
#include "scenes/Rest.h"
#include "viewer/edit/Pick.h"

namespace tessera::viewer {
namespace {

/// Whether a change sets the position or orientation of a camera.
bool places(const scenes::CameraChange& change) {
    return change.eyeWS || change.targetWS || change.upWS;
}

} // namespace

ShownCamera::ShownCamera(scenes::Scene& scene, const scenes::Box3& boundsWS)
    : scene_(scene), boundsWS_(boundsWS), cameras_(scene.cameras), loadedCameras_(cameras_),
      rig_(cameras_.front(), poseThrough(cameras_.front()), boundsWS_) {}

bool ShownCamera::isElsewhere(const CameraView& view) const {
    return view.camera != index_ || !(view.placed == placed_) || view.rig.pose() != rig_.pose() || !rig_.isAtRest();
}

void ShownCamera::use(int camera, const scenes::CameraChange& change) {
    giveBack();
    index_ = camera;
    place(change);
}

void ShownCamera::place(const scenes::CameraChange& change) {
    const scenes::Camera camera = scenes::changedCamera(sceneCamera(), change);
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    placed_ = change;
    begin(camera, change.targetWS ? poseOf(camera, glm::distance(eyeWS, *change.targetWS)) : poseThrough(camera));
}

scenes::CameraChange ShownCamera::change() const {
    if (!rig_.isMoved()) return placed_;
    // The change has eye and target, so it replaces an earlier position; other earlier changes remain.
    scenes::CameraChange change = changeOf(rig_.pose(), rig_.start());
    change.fovYDegrees = placed_.fovYDegrees;
    if (!change.halfHeightMetres) change.halfHeightMetres = placed_.halfHeightMetres;
    if (!change.nearMetres) change.nearMetres = placed_.nearMetres;
    if (!change.farMetres) change.farMetres = placed_.farMetres;
    return change;
}

void ShownCamera::applyRig() {
    scene_.cameras[std::size_t(index_)] = rig_.camera();
    ++revision_;
}

void ShownCamera::changeFieldOfView(double degrees) {
    if (rig_.start().projection != scenes::Projection::Perspective) return;
    scenes::CameraChange change = placed_;
    change.fovYDegrees = degrees;
    scenes::Camera start = scenes::changedCamera(sceneCamera(), change);
    start.worldFromCamera = rig_.start().worldFromCamera; // a clip may have moved the scene's camera
    const bool isMoved = rig_.isMoved();
    const CameraPose pose = rig_.pose();
    placed_ = change;
    begin(start, rig_.home());
    if (!isMoved) return;
    rig_.jumpTo(pose);
    applyRig();
}

void ShownCamera::goTo(const scenes::Camera& other) {
    if (other.projection == scenes::Projection::Perspective && other.fovYRadians != rig_.start().fovYRadians)
        changeFieldOfView(glm::degrees(other.fovYRadians));
    CameraPose pose = poseThrough(other);
    pose.nearMetres = rig_.home().nearMetres;
    pose.nearFocusMetres = rig_.home().nearFocusMetres;
    rig_.goTo(pose);
}

void ShownCamera::exchange(CameraView& other) {
    CameraView before = view();
    giveBack();
    index_ = other.camera;
    placed_ = other.placed;
    rig_ = std::move(other.rig);
    rig_.moveAs(before.rig);
    applyRig();
    goWithClip(); // the clip may have advanced
    other = std::move(before);
}

void ShownCamera::removeLast(std::size_t count) {
    for (std::vector<scenes::Camera>* const cameras : {&scene_.cameras, &cameras_, &loadedCameras_})
        cameras->erase(cameras->end() - std::ptrdiff_t(count), cameras->end());
}

void ShownCamera::becomeOwn() {
    cameras_ = loadedCameras_ = scene_.cameras;
    placed_ = {};
    rig_.startHere(sceneCamera());
}

bool ShownCamera::followClip(bool follows) {
    mayFollow_ = follows;
    if (!follows || followsClip()) return false;
    placed_ = {};
    begin(sceneCamera(), poseOf(sceneCamera(), rig_.home().focusMetres));
    return true;
}

void ShownCamera::takeUp() {
    takeOwn();
    scene_.cameras[std::size_t(index_)] = rig_.camera();
    goWithClip();
}

CameraPose ShownCamera::poseThrough(const scenes::Camera& camera) const {
    constexpr int kSidePixels = 3; // the middle pixel looks along the axis
    const auto seen = pickedByRay(scene_, camera, glm::ivec2(kSidePixels), glm::ivec2(kSidePixels / 2));
    if (!seen) return poseOf(camera, boundsWS_);
    const glm::dvec3 forwardWS = -glm::dvec3(camera.worldFromCamera[2]);
    const double focusMetres = glm::dot(seen->positionWS - glm::dvec3(camera.worldFromCamera[3]), forwardWS);
    return focusMetres > 0.0 ? poseOf(camera, focusMetres) : poseOf(camera, boundsWS_);
}

bool ShownCamera::isLed() const {
    return mayFollow_ && !rig_.isMoved() && rig_.isAtRest() && !places(placed_);
}

void ShownCamera::goWithClip() {
    const auto isShown = [&](const scenes::Carried& carried) { return carried.element == index_; };
    const auto isOfShown = [&](const scenes::RestNumber& rest) {
        return scenes::infoOf(rest.property).owner == scenes::AnimatedOwner::Camera && rest.element == index_;
    };
    if (std::ranges::none_of(scene_.rig.cameras, isShown) && std::ranges::none_of(scene_.rig.numbers, isOfShown))
        return;
    scenes::Camera start = scenes::changedCamera(sceneCamera(), placed_);
    if (places(placed_)) { // it stands still, only its lens may change
        start.worldFromCamera = rig_.start().worldFromCamera;
        rig_.startAt(start, rig_.home());
        return applyRig();
    }
    const CameraPose home = poseOf(start, rig_.home().focusMetres);
    if (isLed()) return begin(start, home);
    rig_.startAt(start, home); // it stays where it is, and the clip's camera becomes its home
    applyRig();
}

void ShownCamera::begin(const scenes::Camera& start, const CameraPose& home) {
    const CameraRig before = rig_;
    rig_ = CameraRig(start, home, boundsWS_);
    rig_.moveAs(before);
    applyRig();
}

scenes::CameraChange changeForAspect(const std::string& source, const scenes::Camera& camera,
                                     const std::optional<double>& aspect) {
    constexpr double kMadeForAspect = 16.0 / 9.0, kTallestDegrees = 120.0, kStepsADegree = 10.0;
    scenes::CameraChange change;
    const bool isMadeForIt =
        scenes::builtinScene(source) != nullptr && camera.projection == scenes::Projection::Perspective;
    if (!isMadeForIt || !aspect || *aspect >= kMadeForAspect) return change;
    const double halfHeight = std::tan(0.5 * camera.fovYRadians) * kMadeForAspect / *aspect;
    const double degrees = glm::degrees(2.0 * std::atan(halfHeight));
    change.fovYDegrees = std::min(std::ceil(kStepsADegree * degrees) / kStepsADegree, kTallestDegrees);
    return change;
}

} // namespace tessera::viewer
