#pragma once
#include <glm/glm.hpp>

#include "scenes/Light.h"

namespace tessera::test {

/// 1 m wide and high, or of a radius of 0.3 m, with its width level. A polygon is a square.
inline scenes::Light areaLight(scenes::LightType type, const glm::dvec3& positionWS, const glm::dvec3& directionWS,
                               float radiance) {
    scenes::Light light;
    light.type = type;
    light.positionWS = positionWS;
    light.directionWS = glm::normalize(directionWS);
    const glm::dvec3 aside = glm::cross(glm::dvec3(0.0, 1.0, 0.0), light.directionWS);
    light.alongWS = glm::length(aside) > 1e-3 ? glm::normalize(aside) : glm::dvec3(1.0, 0.0, 0.0);
    light.radiusMetres = type == scenes::LightType::Rectangle ? 0.0f : 0.3f;
    light.intensity = radiance;
    return light;
}

} // namespace tessera::test
