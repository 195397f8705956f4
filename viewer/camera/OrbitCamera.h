#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// Turns about a pivot, moves across the picture and zooms, all damped. Pixels count from the top, `heightPixels` is
/// the picture's; sub-pixel steps are welcome.
class OrbitCamera {
public:
    /// `lens` says projection and field of view.
    OrbitCamera(const CameraPose& pose, const scenes::Camera& lens);

    /// Drags a ball about the pivot, half as high as the picture: the point of its front under the cursor follows.
    void rotate(const glm::dvec2& dragPixels, double heightPixels);
    /// The point under the cursor, at the pivot's depth, follows exactly.
    void pan(const glm::dvec2& dragPixels, double heightPixels);
    /// Scales the distance (orthographic: the height of the picture) by `factor` > 0, below 1 to go nearer. The point
    /// under the cursor, at the pivot's depth, stays there; the cursor is given from the picture's centre.
    void zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels);

    /// Goes to a pose, damped; the shorter way round. At rest it is exactly there.
    void goTo(const CameraPose& pose);
    /// Is at a pose at once.
    void jumpTo(const CameraPose& pose);

    /// Moves on by a span of time. Two half steps are one step. Nearer to the goal than a visible pixel it is there.
    void advance(double stepSeconds, double heightPixels);
    /// Nothing will change until something is asked: redrawing may end.
    bool isAtRest() const { return shown_ == goal_; }

    const CameraPose& pose() const { return shown_.pose; } ///< what to draw
    const CameraPose& goal() const { return goal_.pose; }  ///< what it moves towards
    const glm::dvec3& pivotWS() const { return shown_.pivotWS; }

private:
    /// The eye follows from the pivot wherever one of them moves. That of a pose which was asked for stays as it was
    /// said: through the pivot and back, rounding would move it.
    struct State {
        glm::dvec3 pivotWS{0.0};
        CameraPose pose;
        bool operator==(const State&) const = default;
        void placeEye() { pose.eyeWS = pivotWS - pose.focusMetres * pose.heading.forwardWS(); }
    };
    static State stateOf(const CameraPose& pose);
    void changeGoal(State goal);
    double pixelsToGoal(double heightPixels) const;

    scenes::Camera lens_;
    State shown_, goal_;
};

} // namespace tessera::viewer
