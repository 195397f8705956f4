#pragma once
#include <vector>

#include "scenes/AreaLight.h"
#include "tests/unit/viewer/CameraTest.h"
#include "viewer/camera/PictureView.h"

namespace tessera::viewer::test {

/// A light with an oblique direction and sizes of every kind.
inline scenes::Light askewLight(scenes::LightType type, const glm::dvec3& positionWS = glm::dvec3(0.0)) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(glm::dvec3(0.3, -0.8, 0.4));
    light.alongWS = scenes::usualAlong(light.directionWS);
    light.widthMetres = 0.8f;
    light.heightMetres = 0.5f;
    light.lengthMetres = 1.1f;
    light.radiusMetres = 0.3f;
    return light;
}

/// A perspective and an orthographic view of 1000 x 1000 pixels.
inline std::vector<PictureView> twoViews(const glm::dvec3& eyeWS, const glm::dvec3& targetWS) {
    const glm::dvec2 size(1000.0, kHeightPixels);
    return {{perspective(eyeWS, targetWS), size}, {orthographic(eyeWS, targetWS, 1.5), size}};
}

} // namespace tessera::viewer::test
