#pragma once
#include "renderer/frame/CameraView.h"
#include "renderer/frame/PackedLights.h"
#include "scenes/Light.h"
#include "tests/support/Random.h"

namespace tessera::test {

/// Packs lights for a camera; the default one is at the origin, looks along -z and has a field of view of 45 degrees.
inline frame::PackedLights pack(const std::vector<scenes::Light>& lights, const frame::FrameSettings& settings = {},
                                const scenes::Camera& camera = {}) {
    scenes::Scene scene;
    scene.lights = lights;
    return packLights(scene, makeCameraView(camera, {640, 360}, settings.space, glm::vec3(0.0f)), settings);
}

/// Sets every size of a light at random between these bounds.
inline void giveSizes(scenes::Light& light, Random& random, double leastMetres, double mostMetres) {
    for (float scenes::Light::*metres : {&scenes::Light::widthMetres, &scenes::Light::heightMetres,
                                         &scenes::Light::lengthMetres, &scenes::Light::radiusMetres})
        light.*metres = float(random.logarithmic(leastMetres, mostMetres));
}

} // namespace tessera::test
