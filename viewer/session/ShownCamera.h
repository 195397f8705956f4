#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Clips.h"
#include "viewer/session/CameraRig.h"

namespace tessera::viewer {

/// Which camera is used, and its pose.
struct CameraView {
    int camera = 0;
    scenes::CameraChange placed; ///< ShownCamera::placed()
    CameraRig rig;
};

/// The displayed camera of a scene: its index, its placement by a command line, and the user's movements. The scene
/// contains this camera; the scene's original one is kept aside.
class ShownCamera {
public:
    /// Begins with the first camera. The scene's address must stay fixed. The bounds are over its clips.
    ShownCamera(scenes::Scene& scene, const scenes::Box3& boundsWS);
    ShownCamera(const ShownCamera&) = delete;
    ShownCamera& operator=(const ShownCamera&) = delete;

    /// The scene's cameras at the displayed time, without user movements.
    const std::vector<scenes::Camera>& cameras() const { return cameras_; }
    /// The same as they were loaded.
    const std::vector<scenes::Camera>& loadedCameras() const { return loadedCameras_; }
    int index() const { return index_; }
    CameraRig& rig() { return rig_; }
    const CameraRig& rig() const { return rig_; }
    /// The latest change passed to place(); empty if the scene's camera is used unchanged.
    const scenes::CameraChange& placed() const { return placed_; }
    CameraView view() const { return {index_, placed_, rig_}; }
    /// Whether it differs from a view, or is moving.
    bool isElsewhere(const CameraView& view) const;
    /// Counts movements.
    std::uint64_t revision() const { return revision_; }

    /// Switches to another of the scene's cameras, placed by a change.
    void use(int camera, const scenes::CameraChange& change);
    /// Begins with a change of the scene's camera, bit-identical to changedCamera(). Orbits turn about the change's
    /// target. Throws InputError for values that no camera can have, without any effect.
    void place(const scenes::CameraChange& change);
    /// The change that turns the scene's camera into the displayed one, bit-exact, as for a command line. Empty if they
    /// are the same.
    scenes::CameraChange change() const;
    /// Copies the rig's camera to the scene. To be called after the rig has moved.
    void applyRig();
    /// Changes the field of view of a perspective camera; its pose and home stay.
    void changeFieldOfView(double degrees);
    /// Moves to the pose and field of view of another camera.
    void goTo(const scenes::Camera& other);
    /// Exchanges the current view and another.
    void exchange(CameraView& other);
    /// Removes the last `count` cameras of the scene. The displayed one is not among them.
    void removeLast(std::size_t count);
    /// To be called when a file was saved with the displayed cameras: they become the scene's own, and the rig starts
    /// here.
    void becomeOwn();

    // ---- Clips, which animate the scene's own cameras ----
    /// Whether the playing clip animates this camera, followed or not.
    bool isOfClip() const { return scenes::movesCamera(scene_, index_); }
    /// Whether it follows the clip. A camera that was moved by hand, or placed, does not.
    bool followsClip() const { return isLed() && isOfClip(); }
    /// Moves to the clip's camera and follows it, or stays here. Returns whether it moved.
    bool followClip(bool follows);
    /// Puts the scene's own camera back into the scene, for clips to animate.
    void giveBack() { scene_.cameras[std::size_t(index_)] = sceneCamera(); }
    /// Takes over the scene's cameras as its own, none of which may be the user's at this point.
    void takeOwn() { cameras_ = scene_.cameras; }
    /// The same, and then displays the camera of the clip if it follows that, else the user's.
    void takeUp();

private:
    const scenes::Camera& sceneCamera() const { return cameras_[std::size_t(index_)]; }
    /// A pose whose pivot is the surface at the image centre, else the centre of the scene.
    CameraPose poseThrough(const scenes::Camera& camera) const;
    /// Whether it follows the scene's camera.
    bool isLed() const;
    /// Moves to the clip's camera if it follows that, else back to the rig's.
    void goWithClip();
    /// Restarts the rig with a camera and its pose.
    void begin(const scenes::Camera& start, const CameraPose& home);

    scenes::Scene& scene_;
    scenes::Box3 boundsWS_;
    std::vector<scenes::Camera> cameras_, loadedCameras_;
    bool mayFollow_ = true; ///< whether it may follow the clip's camera
    int index_ = 0;
    scenes::CameraChange placed_; ///< the change by which the rig's start camera was made
    CameraRig rig_;
    std::uint64_t revision_ = 0;
};

/// The change of a built-in scene's camera, made for 16:9, for an image of an aspect (width over height): widens the
/// vertical field of view so that narrower images keep the 16:9 width, up to a limit beyond which the corners are
/// distorted. Rounded up to tenths of a degree for the commands that repeat it. Empty for other scenes; `source` is as
/// passed to loadScene().
scenes::CameraChange changeForAspect(const std::string& source, const scenes::Camera& camera,
                                     const std::optional<double>& aspect);

} // namespace tessera::viewer
