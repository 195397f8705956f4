#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// Orbit camera: rotates about a pivot, pans and zooms, all damped. Pixels count from the top, `heightPixels` is the
/// image height; sub-pixel steps are supported.
class OrbitCamera {
public:
    /// `lens` supplies projection and field of view.
    OrbitCamera(const CameraPose& pose, const scenes::Camera& lens);

    /// Rotates a ball about the pivot, half as high as the image: the point on its front under the cursor follows.
    void rotate(const glm::dvec2& dragPixels, double heightPixels);
    /// The point under the cursor, at the pivot's depth, follows exactly.
    void pan(const glm::dvec2& dragPixels, double heightPixels);
    /// Scales the distance (orthographic: the image height) by `factor` > 0; below 1 moves closer. The point under the
    /// cursor, at the pivot's depth, stays fixed; the cursor is relative to the image centre.
    void zoom(double factor, const glm::dvec2& cursorFromCenterPixels, double heightPixels);

    /// Moves to a pose, damped, by the shorter turn. The end pose is exact.
    void goTo(const CameraPose& pose);
    /// Jumps to a pose without damping.
    void jumpTo(const CameraPose& pose);

    /// Advances the movement. Two half steps equal one step. Snaps to the goal below kRestPixels.
    void advance(double stepSeconds, double heightPixels);
    /// Nothing changes until the next input: redrawing may stop.
    bool isAtRest() const { return shown_ == goal_; }

    const CameraPose& pose() const { return shown_.pose; } ///< to be drawn
    const CameraPose& goal() const { return goal_.pose; }  ///< end of the movement
    const glm::dvec3& pivotWS() const { return shown_.pivotWS; }

private:
    /// The eye follows from the pivot when either moves. A requested pose keeps its exact eye, which rounding would
    /// change on the way through the pivot and back.
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
