#include "viewer/session/OpenScene.h"

#include "scenes/Defaults.h"

namespace tessera::viewer {

OpenScene::OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded,
                     scenes::SceneOrigin origin)
    : source_(std::move(source)), load_(load), scene_(std::move(loaded)), origin_(std::move(origin)),
      boundsWS_(scenes::worldBounds(scene_)), cameras_(scene_.cameras),
      rig_(cameras_.front(), poseOf(cameras_.front(), boundsWS_), boundsWS_) {}

void OpenScene::useCamera(int camera) {
    scene_.cameras[std::size_t(camera_)] = sceneCamera();
    camera_ = camera;
    placed_ = {};
    begin(sceneCamera(), poseOf(sceneCamera(), boundsWS_));
}

void OpenScene::becomes(const std::string& file) {
    source_ = file;
    load_ = {};
    scene_.hasDefaultLight = false; // the file has it as a light of its own
    savedEdits_ = edits_;
    cameras_ = scene_.cameras;
    placed_ = {};
    rig_.startHere(sceneCamera());
}

void OpenScene::place(const scenes::CameraChange& change) {
    const scenes::Camera camera = scenes::changedCamera(sceneCamera(), change);
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    placed_ = change;
    begin(camera, change.targetWS ? poseOf(camera, glm::distance(eyeWS, *change.targetWS)) : poseOf(camera, boundsWS_));
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
    scenes::Camera& shown = scene_.cameras[std::size_t(camera_)];
    shown = rig_.camera();
    scenes::aimDefaultLight(scene_, shown);
    ++revision_;
}

} // namespace tessera::viewer
