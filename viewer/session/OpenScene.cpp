#include "viewer/session/OpenScene.h"

namespace tessera::viewer {

OpenScene::OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded,
                     scenes::SceneOrigin origin)
    : source_(std::move(source)), load_(load), scene_(std::move(loaded)), origin_(std::move(origin)),
      boundsWS_(scenes::worldBounds(scene_)), cameras_(scene_.cameras), rig_(cameras_.front(), boundsWS_) {}

void OpenScene::useCamera(int camera) {
    const CameraRig::Mode mode = rig_.mode();
    scene_.cameras[std::size_t(camera_)] = cameras_[std::size_t(camera_)];
    camera_ = camera;
    rig_ = CameraRig(cameras_[std::size_t(camera)], boundsWS_);
    rig_.setMode(mode);
    applyRig();
}

void OpenScene::becomes(const std::string& file) {
    source_ = file;
    load_ = {};
    savedEdits_ = edits_;
    cameras_ = scene_.cameras;
    const CameraRig::Mode mode = rig_.mode();
    rig_ = CameraRig(cameras_[std::size_t(camera_)], boundsWS_);
    rig_.setMode(mode);
    applyRig();
}

void OpenScene::place(const scenes::CameraChange& change) {
    if (change == scenes::CameraChange()) return;
    rig_.jumpTo(poseOf(scenes::changedCamera(rig_.start(), change), boundsWS_));
    applyRig();
}

void OpenScene::applyRig() {
    scene_.cameras[std::size_t(camera_)] = rig_.camera();
    ++revision_;
}

} // namespace tessera::viewer
