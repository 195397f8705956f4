#pragma once
#include <glm/glm.hpp>

#include "scenes/AreaLight.h"
#include "scenes/Material.h"
#include "scenes/Scene.h"
#include "tests/support/AreaLights.h"

/// Lights and surfaces of tests of area lights.
namespace tessera::test {

/// 1 m wide and high, or of a radius of 0.3 m, with its width level. A polygon is a square.
inline scenes::Light areaLight(scenes::LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS,
                               float radiance) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(directionWS);
    light.alongWS = scenes::usualAlong(light.directionWS);
    light.radiusMetres = type == scenes::LightType::Rectangle ? 0.0f : 0.3f;
    light.intensity = radiance;
    return light;
}

/// The scene's lights and one of each type, with and without a range, from the front and on both sides.
inline scenes::Scene withAreaLights(scenes::Scene scene) {
    double x = -1.5;
    for (const scenes::LightType type : kAreaTypes) {
        scenes::Light light = areaLight(type, {x, 1.0, 1.5}, {-0.3 * x, -0.5, -1.0}, 3.0f);
        light.rangeMetres = type == scenes::LightType::Disk ? 4.0f : scenes::kInfinity;
        light.isTwoSided = type == scenes::LightType::Disk;
        light.corners.metres[2] = {0.1f, -0.1f}; // points inwards
        scene.lights.push_back(light);
        x += 1.0;
    }
    return scene;
}

/// Of both sides of a quad.
inline scenes::Material twoSidedMetal(double metallic, double perceptualRoughness) {
    scenes::Material metal;
    metal.metallic = float(metallic);
    metal.perceptualRoughness = float(perceptualRoughness);
    metal.doubleSided = true;
    return metal;
}

/// A coat over a dielectric.
inline scenes::Material coatedSheet() {
    scenes::Material material = twoSidedMetal(0.0, 0.6);
    material.name = "coated sheet";
    material.clearcoat = 1.0f;
    material.clearcoatPerceptualRoughness = 0.3f;
    return material;
}

inline scenes::Material velvet() {
    scenes::Material material = twoSidedMetal(0.0, 1.0);
    material.name = "velvet";
    material.baseColor = glm::vec4(glm::vec3(0.2f), 1.0f);
    material.sheenColor = glm::vec3(0.8f);
    material.sheenPerceptualRoughness = 0.5f;
    return material;
}

} // namespace tessera::test
