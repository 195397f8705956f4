#pragma once
#include <glm/glm.hpp>

namespace tessera::viewer {

/// The orientation of a camera: yaw and pitch, changed by mouse and keys, and the roll that a scene's camera may have.
struct Heading {
    double yawRadians = 0.0;   ///< about world Y, counter-clockwise from above; 0 looks along -Z
    double pitchRadians = 0.0; ///< above the horizon, at most a right angle either way
    double rollRadians = 0.0;  ///< about the view; positive lifts the camera's right side

    glm::dvec3 forwardWS() const;
    glm::dvec3 rightWS() const;
    glm::dvec3 upWS() const;
    bool operator==(const Heading&) const = default;
};

/// Steepest pitch that turning reaches. Straight down, left and right are undefined; half a degree before, the image
/// still shows what is directly below.
inline constexpr double kMostPitchRadians = 1.5620696805349397;

/// The heading of a rotation with columns right, up and back. Straight up or down, where yaw and roll coincide, the
/// roll is 0.
Heading headingOf(const glm::dmat3& worldFromCamera);

/// Turns left and up by small angles in image space, for any roll and pitch: the image centre moves by these angles, on
/// the steepest headings by less, so that the yaw does not spin. The pitch is limited to kMostPitchRadians; a steeper
/// one, as of a scene's camera, does not increase.
Heading turned(const Heading& heading, double leftRadians, double upRadians);

} // namespace tessera::viewer
