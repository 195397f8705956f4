#include "viewer/camera/Heading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::viewer {
namespace {

/// Right and up without roll.
glm::dvec3 levelRightWS(const Heading& heading) {
    return {std::cos(heading.yawRadians), 0.0, -std::sin(heading.yawRadians)};
}

glm::dvec3 levelUpWS(const Heading& heading) {
    return glm::cross(levelRightWS(heading), heading.forwardWS());
}

} // namespace

glm::dvec3 Heading::forwardWS() const {
    const double level = std::cos(pitchRadians);
    return {-std::sin(yawRadians) * level, std::sin(pitchRadians), -std::cos(yawRadians) * level};
}

glm::dvec3 Heading::rightWS() const {
    return std::cos(rollRadians) * levelRightWS(*this) + std::sin(rollRadians) * levelUpWS(*this);
}

glm::dvec3 Heading::upWS() const {
    return std::cos(rollRadians) * levelUpWS(*this) - std::sin(rollRadians) * levelRightWS(*this);
}

Heading headingOf(const glm::dmat3& worldFromCamera) {
    const glm::dvec3 rightWS = worldFromCamera[0];
    const glm::dvec3 forwardWS = -worldFromCamera[2];
    const double level = std::hypot(forwardWS.x, forwardWS.z);
    Heading heading;
    // A matrix's forward axis is accurate to about 1e-16; the yaw of a shorter horizontal part would be noise.
    constexpr double kShortestLevel = 1e-9;
    if (level < kShortestLevel) {
        heading.pitchRadians = std::copysign(0.5 * std::numbers::pi, forwardWS.y);
        heading.yawRadians = std::atan2(-rightWS.z, rightWS.x);
        return heading;
    }
    heading.pitchRadians = std::atan2(forwardWS.y, level);
    heading.yawRadians = std::atan2(-forwardWS.x, -forwardWS.z);
    const double roll = std::atan2(glm::dot(rightWS, levelUpWS(heading)), glm::dot(rightWS, levelRightWS(heading)));
    // Removes the roll that rounding leaves to an upright camera, which would never be level again.
    constexpr double kLeastRollRadians = 1e-12;
    heading.rollRadians = std::abs(roll) < kLeastRollRadians ? 0.0 : roll;
    return heading;
}

Heading turned(const Heading& heading, double leftRadians, double upRadians) {
    const double c = std::cos(heading.rollRadians), s = std::sin(heading.rollRadians);
    // A yaw moves the image centre by cos(pitch) only. Beyond 75 degrees this is not compensated.
    constexpr double kLeastLevel = 0.25;
    Heading result = heading;
    result.yawRadians += (c * leftRadians + s * upRadians) / std::max(std::cos(heading.pitchRadians), kLeastLevel);
    const double most = std::max(kMostPitchRadians, std::abs(heading.pitchRadians));
    result.pitchRadians = std::clamp(heading.pitchRadians + c * upRadians - s * leftRadians, -most, most);
    return result;
}

} // namespace tessera::viewer
