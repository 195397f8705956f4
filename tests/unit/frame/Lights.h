#pragma once
#include "renderer/frame/CameraView.h"
#include "renderer/frame/PackedLights.h"
#include "scenes/Light.h"
#include "tests/support/Random.h"

namespace tessera::test {

/// Lights packed for a picture by a camera; the default one is at the origin, looks along -z and sees 45 degrees.
inline frame::PackedLights pack(const std::vector<scenes::Light>& lights, const frame::FrameSettings& settings = {},
                                const scenes::Camera& camera = {}) {
    scenes::Scene scene;
    scene.lights = lights;
    return packLights(scene, makeCameraView(camera, {640, 360}, settings.space, glm::vec3(0.0f)), settings);
}

/// Gives a light sizes of every kind between these, at random.
inline void giveSizes(scenes::Light& light, Random& random, double leastMetres, double mostMetres) {
    for (float scenes::Light::*metres : {&scenes::Light::widthMetres, &scenes::Light::heightMetres,
                                         &scenes::Light::lengthMetres, &scenes::Light::radiusMetres})
        light.*metres = float(random.logarithmic(leastMetres, mostMetres));
}

} // namespace tessera::test
