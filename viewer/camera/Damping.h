#pragma once
#include <cmath>

namespace tessera::viewer {

/// Time constant, in which a damped movement covers all but 1/e of the way: short enough to feel immediate, long enough
/// to smooth the steps of a mouse.
inline constexpr double kDampingSeconds = 0.08;

/// Differences below this fraction of a pixel are invisible, so a movement ends there and redrawing with it.
inline constexpr double kRestPixels = 0.25;

/// Fraction of the remaining way that an exponential approach covers in a step: x += (goal - x) * share. Exact: two
/// half steps equal one step, so that movements do not depend on the frame rate.
inline double dampingShare(double stepSeconds, double dampingSeconds = kDampingSeconds) {
    return -std::expm1(-stepSeconds / dampingSeconds);
}

/// The same for a goal that moves at constant velocity. Returns x after the step, the exact solution of x' = (goal(t) -
/// x) / damping. `goal` is the goal at the end of the step.
template <typename Vector>
Vector dampedBehind(const Vector& from, const Vector& goal, const Vector& goalVelocity, double stepSeconds,
                    double dampingSeconds = kDampingSeconds) {
    const Vector lag = goalVelocity * dampingSeconds;
    const Vector goalBefore = goal - goalVelocity * stepSeconds;
    return goal - lag + (from - goalBefore + lag) * (1.0 - dampingShare(stepSeconds, dampingSeconds));
}

} // namespace tessera::viewer
