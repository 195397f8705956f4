#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Clips.h"
#include "viewer/session/CameraRig.h"

namespace tessera::viewer {

/// Which camera is looked through, and where it is.
struct CameraView {
    int camera = 0;
    scenes::CameraChange placed; ///< ShownCamera::placed()
    CameraRig rig;
};

/// The camera of a scene that is shown: which one it is, where a command line placed it, and where the user moved it.
/// The scene has it so; the scene's own is kept aside.
class ShownCamera {
public:
    /// The first one, to begin with, of a scene that stays where it is. The bounds are over its clips.
    ShownCamera(scenes::Scene& scene, const scenes::Box3& boundsWS);
    ShownCamera(const ShownCamera&) = delete;
    ShownCamera& operator=(const ShownCamera&) = delete;

    /// The cameras of the scene at the time that is shown, without later movements.
    const std::vector<scenes::Camera>& cameras() const { return cameras_; }
    /// The same as its file begins with them.
    const std::vector<scenes::Camera>& loadedCameras() const { return loadedCameras_; }
    int index() const { return index_; }
    CameraRig& rig() { return rig_; }
    const CameraRig& rig() const { return rig_; }
    /// What place() put last; empty where the scene's camera is its own.
    const scenes::CameraChange& placed() const { return placed_; }
    CameraView view() const { return {index_, placed_, rig_}; }
    /// Whether it is elsewhere than a view, or on its way.
    bool isElsewhere(const CameraView& view) const;
    /// Counts movements.
    std::uint64_t revision() const { return revision_; }

    /// Looks through another of the scene's cameras, placed by a change.
    void use(int camera, const scenes::CameraChange& change);
    /// Begins with the change of the scene's camera: what changedCamera() makes of it, to the last bit. Orbiting turns
    /// about the target that it says. Throws InputError for values that no camera can have, and then does nothing.
    void place(const scenes::CameraChange& change);
    /// What makes the camera that is shown of the scene's, as a command line says it, to the last bit. Empty where they
    /// are the same.
    scenes::CameraChange change() const;
    /// Puts the scene's camera to where the rig is. To be called after the rig moved.
    void applyRig();
    /// Gives a perspective camera another field of view; it stays where it is, and so does its home.
    void changeFieldOfView(double degrees);
    /// Goes to where another camera is, with its field of view.
    void goTo(const scenes::Camera& other);
    /// Exchanges where it is and another view.
    void exchange(CameraView& other);
    /// Takes the last `count` cameras from the scene. None of them is shown.
    void removeLast(std::size_t count);
    /// A file has the cameras as they are shown: they are the scene's own, and this one begins here.
    void becomeOwn();

    // ---- Clips, which move the scene's own cameras ----
    /// Whether the clip that plays moves it, or would.
    bool isOfClip() const { return scenes::movesCamera(scene_, index_); }
    /// Whether it goes with the clip: one that was moved by hand, or placed, stays the user's.
    bool followsClip() const { return isLed() && isOfClip(); }
    /// Goes to the clip's camera and along with it, or stays here. Returns whether it went.
    bool followClip(bool follows);
    /// Gives the scene its own camera, for clips to move.
    void giveBack() { scene_.cameras[std::size_t(index_)] = sceneCamera(); }
    /// The scene's cameras, none of which is the user's now, are its own.
    void takeOwn() { cameras_ = scene_.cameras; }
    /// The same, and shows this one where the clip has it, or else where the user has it.
    void takeUp();

private:
    const scenes::Camera& sceneCamera() const { return cameras_[std::size_t(index_)]; }
    /// Orbits turn about what the camera shows in the middle of its picture; where that is nothing, about the middle of
    /// the scene.
    CameraPose poseThrough(const scenes::Camera& camera) const;
    /// Whether it goes where the scene has it.
    bool isLed() const;
    /// Puts it to where the clip has it, or else back to where the rig is.
    void goWithClip();
    /// Begins anew with a camera and its pose.
    void begin(const scenes::Camera& start, const CameraPose& home);

    scenes::Scene& scene_;
    scenes::Box3 boundsWS_;
    std::vector<scenes::Camera> cameras_, loadedCameras_;
    bool mayFollow_ = true; ///< the clip's camera
    int index_ = 0;
    scenes::CameraChange placed_; ///< made the camera that the rig started as
    CameraRig rig_;
    std::uint64_t revision_ = 0;
};

/// What a camera of a built-in scene, which is made for pictures of 16:9, is placed by in one of an aspect, width over
/// height. In a narrower one a taller field of view keeps what it has at the sides, up to one at whose corners things
/// still have their shapes. It is rounded up to tenths of a degree for the commands that repeat it. Empty of other
/// scenes, as loadScene() takes their source.
scenes::CameraChange changeForAspect(const std::string& source, const scenes::Camera& camera,
                                     const std::optional<double>& aspect);

} // namespace tessera::viewer
