#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// Which keys are held; opposite ones cancel.
struct FlyKeys {
    bool forward = false, back = false; ///< W, S
    bool left = false, right = false;   ///< A, D
    bool down = false, up = false;      ///< Q, E, along world Y
    bool fast = false;                  ///< Shift
};

/// Walks through the air by keys and looks by mouse, all damped.
class FlyCamera {
public:
    /// The speed that it begins with is proportional to the size of the scene: a box is crossed in the same time, be
    /// it a ring or a cathedral.
    FlyCamera(const CameraPose& pose, const scenes::Camera& lens, const scenes::Box3& boundsWS);

    /// Mouse look: the view turns the way the mouse goes, as many pixels in the picture's middle as it went.
    void look(const glm::dvec2& movePixels, double heightPixels);
    /// Flies faster by steps, slower where they are negative; two steps are twice as fast. It stays between a
    /// sixteenth and 16 times the speed that it begins with.
    void changeSpeed(double steps);
    /// Is as much faster or slower than it began as another one, which may be of another scene.
    void takeSpeedFactor(const FlyCamera& other) { speedSteps_ = other.speedSteps_; }
    /// Of keys that are held without Shift.
    double metresPerSecond() const;
    /// Keys held from now on.
    void hold(const FlyKeys& keys) { keys_ = keys; }
    /// What keys would move it by, in metres a second.
    glm::dvec3 velocityWS() const;

    /// Goes to a pose, damped; the shorter way round. At rest it is exactly there.
    void goTo(const CameraPose& pose);
    /// Is at a pose at once.
    void jumpTo(const CameraPose& pose);

    /// Moves on by a span of time. Two half steps are one step, also while keys are held.
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
