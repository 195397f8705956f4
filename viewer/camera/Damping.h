#pragma once
#include <cmath>

namespace tessera::viewer {

/// Time in which a damped movement covers all but 1/e of the way: quick enough to feel tied to the hand, long enough to
/// smooth the steps of a mouse.
inline constexpr double kDampingSeconds = 0.08;

/// Differences below this fraction of a pixel are invisible, so a movement ends there and redrawing with it.
inline constexpr double kRestPixels = 0.25;

/// The fraction of the remaining way that an exponential approach covers in a step: x += (goal - x) * share. Exact, so
/// that two half steps are one step and the movement is the same at every frame rate.
inline double dampingShare(double stepSeconds, double dampingSeconds = kDampingSeconds) {
    return -std::expm1(-stepSeconds / dampingSeconds);
}

/// The same for a goal that moves at constant velocity: where x is after the step, the exact solution of
/// x' = (goal(t) - x) / damping. `goal` is where the goal is at the end of the step.
template <typename Vector>
Vector dampedBehind(const Vector& from, const Vector& goal, const Vector& goalVelocity, double stepSeconds,
                    double dampingSeconds = kDampingSeconds) {
    const Vector lag = goalVelocity * dampingSeconds;
    const Vector goalBefore = goal - goalVelocity * stepSeconds;
    return goal - lag + (from - goalBefore + lag) * (1.0 - dampingShare(stepSeconds, dampingSeconds));
}

} // namespace tessera::viewer
