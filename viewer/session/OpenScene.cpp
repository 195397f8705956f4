#include "viewer/session/OpenScene.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "scenes/Defaults.h"
#include "scenes/Pose.h"
#include "viewer/edit/Pick.h"

namespace tessera::viewer {
namespace {

double lastSecondsOf(const scenes::Rig& rig) {
    double seconds = -std::numeric_limits<double>::infinity();
    for (const int clip : rig.playing) seconds = std::max(seconds, scenes::lengthSeconds(rig.clips[std::size_t(clip)]));
    return seconds;
}

} // namespace

OpenScene::OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded,
                     scenes::SceneOrigin origin, std::shared_ptr<const frame::FilteredEnvironment> filtered)
    : source_(std::move(source)), load_(load), scene_(std::move(loaded)), origin_(std::move(origin)),
      boundsWS_(scenes::worldBounds(scene_)), cameras_(scene_.cameras),
      rig_(cameras_.front(), poseThrough(cameras_.front()), boundsWS_), lastSeconds_(lastSecondsOf(scene_.rig)),
      filtered_(std::move(filtered)) {
    scenes::leaveLightsAndCameras(scene_);
}

bool OpenScene::showTime(double timeSeconds) {
    timeSeconds = std::min(timeSeconds, lastSeconds_);
    if (!scenes::isPlaying(scene_) || timeSeconds == askedSeconds_) return false;
    askedSeconds_ = timeSeconds;
    if (timeSeconds == shownSeconds_) return false; // after one that was refused
    try {
        scenes::poseScene(scene_, timeSeconds);
    } catch (...) {
        scenes::poseScene(scene_, shownSeconds_);
        throw;
    }
    shownSeconds_ = timeSeconds;
    ++revision_;
    ++geometryRevision_;
    return true;
}

CameraPose OpenScene::poseThrough(const scenes::Camera& camera) const {
    constexpr int kSidePixels = 3; // the middle one looks along the axis
    const auto seen = pickedByRay(scene_, camera, glm::ivec2(kSidePixels), glm::ivec2(kSidePixels / 2));
    if (!seen) return poseOf(camera, boundsWS_);
    const glm::dvec3 forwardWS = -glm::dvec3(camera.worldFromCamera[2]);
    const double focusMetres = glm::dot(seen->positionWS - glm::dvec3(camera.worldFromCamera[3]), forwardWS);
    return focusMetres > 0.0 ? poseOf(camera, focusMetres) : poseOf(camera, boundsWS_);
}

void OpenScene::useCamera(int camera) {
    scene_.cameras[std::size_t(camera_)] = sceneCamera();
    camera_ = camera;
    placed_ = {};
    begin(sceneCamera(), poseThrough(sceneCamera()));
}

void OpenScene::takeEnvironment(ChosenEnvironment chosen) {
    scene_.environment = std::move(chosen.environment);
    // What was said of the environment before is over.
    std::vector<std::string>& warnings = scene_.warnings;
    std::erase_if(warnings, [&](const std::string& warning) {
        return warning == scenes::kDefaultLightWarning ||
               std::ranges::find(environmentWarnings_, warning) != environmentWarnings_.end();
    });
    environmentWarnings_ = std::move(chosen.warnings);
    warnings.insert(warnings.end(), environmentWarnings_.begin(), environmentWarnings_.end());
    filtered_ = std::move(chosen.filtered);
    ++environmentRevision_;
    touch();
}

void OpenScene::becomes(const std::string& file) {
    source_ = file;
    scenes::LoadOptions load; // the file says the rest
    load.clip = std::move(load_.clip);
    load_ = std::move(load);
    savedEdits_ = edits_;
    cameras_ = scene_.cameras;
    placed_ = {};
    rig_.startHere(sceneCamera());
}

void OpenScene::place(const scenes::CameraChange& change) {
    const scenes::Camera camera = scenes::changedCamera(sceneCamera(), change);
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    placed_ = change;
    begin(camera, change.targetWS ? poseOf(camera, glm::distance(eyeWS, *change.targetWS)) : poseThrough(camera));
}

scenes::CameraChange OpenScene::cameraChange() const {
    if (!rig_.isMoved()) return placed_;
    // The change has eye and target, so it replaces an earlier position; other earlier changes remain.
    scenes::CameraChange change = changeOf(rig_.pose(), rig_.start());
    change.fovYDegrees = placed_.fovYDegrees;
    if (!change.halfHeightMetres) change.halfHeightMetres = placed_.halfHeightMetres;
    if (!change.nearMetres) change.nearMetres = placed_.nearMetres;
    if (!change.farMetres) change.farMetres = placed_.farMetres;
    return change;
}

void OpenScene::begin(const scenes::Camera& start, const CameraPose& home) {
    const CameraRig::Mode mode = rig_.mode();
    rig_ = CameraRig(start, home, boundsWS_);
    rig_.setMode(mode);
    applyRig();
}

void OpenScene::applyRig() {
    scene_.cameras[std::size_t(camera_)] = rig_.camera();
    ++revision_;
}

} // namespace tessera::viewer
