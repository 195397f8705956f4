#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// Held movement keys; opposite ones cancel.
struct FlyKeys {
    bool forward = false, back = false; ///< W, S
    bool left = false, right = false;   ///< A, D
    bool down = false, up = false;      ///< Q, E, along world Y
    bool fast = false;                  ///< Shift
};

/// First-person camera: flies by keys and looks around by mouse, both damped.
class FlyCamera {
public:
    /// The initial speed is proportional to the scene's size, so that a ring and a cathedral are crossed in the same
    /// time.
    FlyCamera(const CameraPose& pose, const scenes::Camera& lens, const scenes::Box3& boundsWS);

    /// Mouse look: turns the view in the direction of the mouse, by as many pixels at the image centre as it moved.
    void look(const glm::dvec2& movePixels, double heightPixels);
    /// Changes the speed by steps: two steps double it, negative ones reduce it. It stays between a sixteenth and 16
    /// times the initial speed.
    void changeSpeed(double steps);
    /// Takes the speed relative to the initial one from another camera, possibly of another scene.
    void takeSpeedFactor(const FlyCamera& other) { speedSteps_ = other.speedSteps_; }
    /// Speed of held keys without Shift.
    double metresPerSecond() const;
    /// Sets the keys held from now on.
    void hold(const FlyKeys& keys) { keys_ = keys; }
    /// Velocity from the held keys, in metres per second.
    glm::dvec3 velocityWS() const;

    /// Moves to a pose, damped, by the shorter turn. The end pose is exact.
    void goTo(const CameraPose& pose);
    /// Jumps to a pose without damping.
    void jumpTo(const CameraPose& pose);

    /// Advances the movement. Two half steps equal one step, also while keys are held.
    void advance(double stepSeconds, double heightPixels);
    bool isAtRest() const;

    const CameraPose& pose() const { return shown_; }
    const CameraPose& goal() const { return goal_; }

private:
    double pixelsToGoal(double heightPixels) const;

    scenes::Camera lens_;
    double usualMetresPerSecond_;
    double speedSteps_ = 0.0;
    FlyKeys keys_;
    CameraPose shown_, goal_;
};

} // namespace tessera::viewer
