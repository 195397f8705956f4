#pragma once
#include <cassert>
#include <cmath>

#include <glm/glm.hpp>

namespace tessera::scenes {

/// World-from-camera matrix of an eye that looks at a target along the camera's -Z, with `upWS` up in the image. Eye
/// and target must differ; if `upWS` is parallel to the view, another up vector is used.
inline glm::dmat4 worldFromLookAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS,
                                  const glm::dvec3& upWS = glm::dvec3(0.0, 1.0, 0.0)) {
    assert(glm::distance(eyeWS, targetWS) > 0.0);
    const glm::dvec3 backWS = glm::normalize(eyeWS - targetWS);
    // Below this sine, about 0.06 degrees, the image's roll would depend on rounding.
    constexpr double kSmallestSine = 1e-3;
    glm::dvec3 rightWS = glm::cross(upWS, backWS);
    if (glm::length(rightWS) < kSmallestSine) {
        rightWS = glm::cross(std::abs(backWS.y) < 0.5 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0), backWS);
    }
    rightWS = glm::normalize(rightWS);
    const glm::dvec3 pictureUpWS = glm::cross(backWS, rightWS);
    return {glm::dvec4(rightWS, 0.0), glm::dvec4(pictureUpWS, 0.0), glm::dvec4(backWS, 0.0), glm::dvec4(eyeWS, 1.0)};
}

} // namespace tessera::scenes
