#pragma once
#include <cmath>
#include <numbers>

#include "viewer/camera/Heading.h"

namespace tessera::viewer {

/// The angle equal to `angleRadians` up to whole turns that is nearest to `fromRadians`.
inline double nearestTurn(double angleRadians, double fromRadians) {
    const double turn = 2.0 * std::numbers::pi;
    return angleRadians + turn * std::round((fromRadians - angleRadians) / turn);
}

/// The same heading with yaw and roll nearest to those of `from`, so that the movement takes the shorter turn.
inline Heading nearestTurn(Heading heading, const Heading& from) {
    heading.yawRadians = nearestTurn(heading.yawRadians, from.yawRadians);
    heading.rollRadians = nearestTurn(heading.rollRadians, from.rollRadians);
    return heading;
}

/// An upper bound of the angle between two headings.
inline double turnBetween(const Heading& a, const Heading& b) {
    return std::abs(a.yawRadians - b.yawRadians) + std::abs(a.pitchRadians - b.pitchRadians) +
           std::abs(a.rollRadians - b.rollRadians);
}

} // namespace tessera::viewer
