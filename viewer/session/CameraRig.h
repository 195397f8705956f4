#pragma once
#include "viewer/camera/FlyCamera.h"
#include "viewer/camera/FrameBounds.h"
#include "viewer/camera/OrbitCamera.h"

namespace tessera::viewer {

/// The camera of the window: it starts as a given one and is moved by orbiting or flying; changing between the two
/// moves nothing.
class CameraRig {
public:
    enum class Mode { Orbit, Fly };

    /// `home` is the pose of `start`: poseOf(). The bounds are the scene's.
    CameraRig(const scenes::Camera& start, const CameraPose& home, const scenes::Box3& boundsWS);

    Mode mode() const { return mode_; }
    void setMode(Mode mode);
    /// Mode and flying speed become those of another rig: how one moves is no matter of where one is.
    void moveAs(const CameraRig& other);
    double flyMetresPerSecond() const { return fly_.metresPerSecond(); } ///< without Shift

    /// Drags and wheel of the mouse; each mode takes its own. `heightPixels` is the picture's.
    void rotate(const glm::dvec2& dragPixels, double heightPixels);
    void pan(const glm::dvec2& dragPixels, double heightPixels);
    void zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels);
    /// Steps of the mouse's wheel, positive ones away from the user: nearer to what is under the cursor, or faster
    /// where one flies.
    void wheel(double steps, const glm::dvec2& cursorFromCenterPixels, double heightPixels);
    void hold(const FlyKeys& keys);

    /// All of the scene in view, or all of a box.
    void frameScene(double aspect) { frame(boundsWS_, aspect); }
    void frame(const scenes::Box3& boundsWS, double aspect);
    /// Slides across the picture so that orbits turn about a point, which comes into the picture's middle at its depth.
    /// Nothing happens where it lies behind the eye, or when flying.
    void turnAbout(const glm::dvec3& pivotWS);
    /// Turns about the pivot to another heading.
    void look(const Heading& heading);
    /// Moves to a pose.
    void goTo(const CameraPose& pose);
    /// Back to where it started, exactly.
    void goHome();

    /// Is at a pose at once.
    void jumpTo(const CameraPose& pose);
    void advance(double stepSeconds, double heightPixels);
    bool isAtRest() const;
    /// Makes the current camera, `here`, the start that goHome() returns to. Movements in progress continue.
    void startHere(const scenes::Camera& here) { startAt(here, pose()); }
    /// Makes another camera the start, whose pose is `home`. Moves nothing that was moved.
    void startAt(const scenes::Camera& start, const CameraPose& home);

    const CameraPose& pose() const;
    const scenes::Camera& start() const { return start_; }
    const CameraPose& home() const { return home_; }
    /// Whether it is elsewhere than where it started.
    bool isMoved() const { return pose() != home_; }
    /// The camera to draw: the start camera, to the last bit, while nothing moved it.
    scenes::Camera camera() const { return isMoved() ? cameraAt(pose(), start_) : start_; }

private:
    scenes::Camera start_;
    CameraPose home_;
    scenes::Box3 boundsWS_;
    Mode mode_ = Mode::Orbit;
    OrbitCamera orbit_;
    FlyCamera fly_;
};

} // namespace tessera::viewer
