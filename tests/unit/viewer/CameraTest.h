#pragma once
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/LookAt.h"
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer::test {

/// Height of the tests' images.
inline constexpr double kHeightPixels = 1000.0;

inline scenes::Camera perspective(const glm::dvec3& eyeWS, const glm::dvec3& targetWS,
                                  const glm::dvec3& upWS = glm::dvec3(0.0, 1.0, 0.0), double fovYDegrees = 45.0) {
    scenes::Camera camera;
    camera.name = "test";
    camera.worldFromCamera = scenes::worldFromLookAt(eyeWS, targetWS, upWS);
    camera.fovYRadians = glm::radians(fovYDegrees);
    return camera;
}

inline scenes::Camera orthographic(const glm::dvec3& eyeWS, const glm::dvec3& targetWS, double halfHeightMetres) {
    scenes::Camera camera = perspective(eyeWS, targetWS);
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = halfHeightMetres;
    return camera;
}

using Change = scenes::CameraChange;
/// A change of some members: changing(&Change::fovYDegrees, 20.0).
scenes::CameraChange changing(auto member, const auto& value, const auto&... more) {
    scenes::CameraChange change;
    if constexpr (sizeof...(more) > 0) change = changing(more...);
    change.*member = value;
    return change;
}

/// Projects a point: pixels right of and below the image's centre, and metres ahead.
inline glm::dvec3 shownAt(const scenes::Camera& camera, const glm::dvec3& pointWS) {
    const glm::dvec4 point = glm::inverse(camera.worldFromCamera) * glm::dvec4(pointWS, 1.0);
    const double halfHeight = camera.projection == scenes::Projection::Perspective
                                  ? -point.z * std::tan(0.5 * camera.fovYRadians)
                                  : camera.halfHeightMetres;
    const double scale = 0.5 * kHeightPixels / halfHeight;
    return {point.x * scale, -point.y * scale, -point.z};
}

/// Expects two cameras to show some points at the same place, to within `pixels`.
inline void expectSamePicture(const scenes::Camera& a, const scenes::Camera& b, double pixels) {
    for (const glm::dvec3& pointCS :
         {glm::dvec3(0.0, 0.0, -3.0), glm::dvec3(1.0, -0.5, -4.0), glm::dvec3(-2.0, 1.5, -9.0)}) {
        const glm::dvec3 pointWS(a.worldFromCamera * glm::dvec4(pointCS, 1.0));
        const glm::dvec3 inA = shownAt(a, pointWS), inB = shownAt(b, pointWS);
        EXPECT_NEAR(inA.x, inB.x, pixels);
        EXPECT_NEAR(inA.y, inB.y, pixels);
        EXPECT_NEAR(inA.z, inB.z, 1e-9 * inA.z);
    }
}

/// Various cameras. Conversion through the pivot and back would move the eye of many of them by rounding.
inline std::vector<scenes::Camera> manyCameras() {
    std::vector<scenes::Camera> cameras;
    for (int i = 0; i < 50; ++i) {
        const double angle = 0.7 * i;
        cameras.push_back(perspective({3.2 * std::cos(angle), 0.1 * i, 4.9 * std::sin(angle)}, {0.1, 1.0, 0.3}));
    }
    return cameras;
}

inline constexpr double kLongSeconds = 10.0; ///< any damping is over by then
inline const scenes::Box3 kBox{glm::dvec3(-2.0, 0.0, -3.0), glm::dvec3(4.0, 5.0, 1.0)};

} // namespace tessera::viewer::test
