#pragma once
#include <glm/glm.hpp>

namespace tessera::viewer {

/// Which way a camera looks: the angles that mouse and keys change, and the roll that a scene's camera may have.
struct Heading {
    double yawRadians = 0.0;   ///< about world Y, counter-clockwise from above; 0 looks along -Z
    double pitchRadians = 0.0; ///< above the horizon, at most a right angle either way
    double rollRadians = 0.0;  ///< about the view; positive lifts the camera's right side

    glm::dvec3 forwardWS() const;
    glm::dvec3 rightWS() const;
    glm::dvec3 upWS() const;
    bool operator==(const Heading&) const = default;
};

/// Steepest pitch that turning leads to. Straight down left and right lose their meaning; half a degree before, the
/// picture still shows what is right below.
inline constexpr double kMostPitchRadians = 1.5620696805349397;

/// The heading of a rotation whose columns are right, up and back. Straight up or down, where yaw and roll are one, the
/// roll is 0.
Heading headingOf(const glm::dmat3& worldFromCamera);

/// Turns by small angles in the picture: to the left and up on it, for any roll and pitch, so that what is in its
/// middle moves by these angles; on the steepest headings by less, lest the yaw spin. The pitch ends at
/// kMostPitchRadians; one that is steeper already, as a scene's camera may have it, becomes no steeper.
Heading turned(const Heading& heading, double leftRadians, double upRadians);

} // namespace tessera::viewer
