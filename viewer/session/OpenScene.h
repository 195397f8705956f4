#pragma once
#include <string>
#include <vector>

#include "scenes/write/SceneOrigin.h"
#include "viewer/session/CameraRig.h"

namespace tessera::viewer {

/// A scene that is open: as it was loaded, with what was edited since. Its address is fixed, since a renderer draws it.
class OpenScene {
public:
    OpenScene(std::string source, const scenes::LoadOptions& load, scenes::Scene loaded, scenes::SceneOrigin origin);
    OpenScene(const OpenScene&) = delete;
    OpenScene& operator=(const OpenScene&) = delete;

    const std::string& source() const { return source_; } ///< as loadScene() takes it
    const scenes::SceneOrigin& origin() const { return origin_; }
    /// Lights or materials were edited since the scene was loaded or saved.
    bool isEdited() const { return edits_ != savedEdits_; }
    /// What is open is a file from now on that holds every edit, and the camera where it is.
    void becomes(const std::string& file);
    const scenes::LoadOptions& load() const { return load_; }
    const scenes::Scene& scene() const { return scene_; }
    /// For edits of lights and materials. Whoever edits says touch().
    scenes::Scene& edit() { return scene_; }
    /// Lights or materials were edited, or, with `material`, one of its materials.
    void touch() {
        ++revision_;
        ++edits_;
    }
    void touchMaterials() {
        touch();
        ++materialRevision_;
    }
    /// Counts whatever changes the picture: edits, and movements of the camera.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t materialRevision() const { return materialRevision_; }

    const scenes::Box3& boundsWS() const { return boundsWS_; }
    /// The cameras as the scene has them, whatever was moved since.
    const std::vector<scenes::Camera>& cameras() const { return cameras_; }
    int camera() const { return camera_; }
    CameraRig& rig() { return rig_; }
    const CameraRig& rig() const { return rig_; }
    /// Looks through another of the scene's cameras.
    void useCamera(int camera);
    /// Looks from where the change puts the camera. Throws InputError for what no camera can have.
    void place(const scenes::CameraChange& change);
    /// Puts the scene's camera to where the rig is. To be called after the rig moved.
    void applyRig();

private:
    std::string source_;
    scenes::LoadOptions load_;
    scenes::Scene scene_;
    scenes::SceneOrigin origin_;
    scenes::Box3 boundsWS_;
    std::vector<scenes::Camera> cameras_;
    int camera_ = 0;
    CameraRig rig_;
    std::uint64_t revision_ = 0;
    std::uint64_t edits_ = 0, savedEdits_ = 0;
    std::uint64_t materialRevision_ = 0;
};

} // namespace tessera::viewer
