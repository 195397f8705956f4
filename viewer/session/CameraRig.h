#pragma once
#include "viewer/camera/FlyCamera.h"
#include "viewer/camera/FrameBounds.h"
#include "viewer/camera/OrbitCamera.h"

namespace tessera::viewer {

/// The window's camera: starts as a given one and orbits or flies; switching the mode does not move it.
class CameraRig {
public:
    enum class Mode { Orbit, Fly };

    /// `home` is the pose of `start`: poseOf(). The bounds are the scene's.
    CameraRig(const scenes::Camera& start, const CameraPose& home, const scenes::Box3& boundsWS);

    Mode mode() const { return mode_; }
    void setMode(Mode mode);
    /// Takes mode and flying speed from another rig, but not the pose.
    void moveAs(const CameraRig& other);
    double flyMetresPerSecond() const { return fly_.metresPerSecond(); } ///< without Shift

    /// Mouse drags and wheel, as the mode defines them. `heightPixels` is the image height.
    void rotate(const glm::dvec2& dragPixels, double heightPixels);
    void pan(const glm::dvec2& dragPixels, double heightPixels);
    void zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels);
    /// Steps of the mouse wheel, positive away from the user: closer to the point under the cursor, or faster when
    /// flying.
    void wheel(double steps, const glm::dvec2& cursorFromCenterPixels, double heightPixels);
    void hold(const FlyKeys& keys);

    /// Brings the whole scene, or a box, into view.
    void frameScene(double aspect) { frame(boundsWS_, aspect); }
    void frame(const scenes::Box3& boundsWS, double aspect);
    /// Pans so that orbits turn about a point, which moves to the image centre at its depth. No effect if it lies
    /// behind the eye, or when flying.
    void turnAbout(const glm::dvec3& pivotWS);
    /// Turns to another heading: about the pivot if the eye is within the scene, else with the whole scene in view.
    void look(const Heading& heading, double aspect);
    /// Moves to a pose, damped.
    void goTo(const CameraPose& pose);
    /// Moves back to the start pose, exactly.
    void goHome();

    /// Jumps to a pose without damping.
    void jumpTo(const CameraPose& pose);
    void advance(double stepSeconds, double heightPixels);
    bool isAtRest() const;
    /// Makes the current camera, `here`, the start that goHome() returns to. Movements in progress continue.
    void startHere(const scenes::Camera& here) { startAt(here, pose()); }
    /// Makes another camera the start, with the pose `home`. A moved camera stays where it is.
    void startAt(const scenes::Camera& start, const CameraPose& home);

    const CameraPose& pose() const;
    const scenes::Camera& start() const { return start_; }
    const CameraPose& home() const { return home_; }
    /// Whether it has left the start pose.
    bool isMoved() const { return pose() != home_; }
    /// The camera to draw: bit-identical to the start camera while unmoved.
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
