#pragma once
#include <numbers>

#include "scenes/AreaLight.h"
#include "validation/reference/AreaLights.h"

/// Area lights for the reference's integrals, and what a point has of them.
namespace tessera::test {

/// Of the integral as it is by default. Rules that differ by 2e-5 of it are themselves a few times 1e-6 wrong; most of
/// that is where the horizon cuts a light.
inline constexpr double kCubature = 2e-5;

/// Of radiance 1, without a range.
inline reference::ShiningLight shiningArea(scenes::LightType type, const glm::dvec3& middle,
                                           const glm::dvec3& direction = {0, 0, -1}) {
    reference::ShiningLight shining;
    shining.light.type = type;
    shining.light.directionWS = direction;
    shining.light.radiusMetres = 0.5f;
    shining.color = glm::dvec3(1.0);
    shining.positionRWS = middle;
    shining.rangeMetres = double(scenes::kInfinity);
    return shining;
}

inline reference::ShiningLight rectangle(const glm::dvec3& middle, const glm::dvec3& direction, const glm::dvec3& along,
                                         float width, float height) {
    reference::ShiningLight shining = shiningArea(scenes::LightType::Rectangle, middle, direction);
    shining.light.alongWS = along;
    shining.light.widthMetres = width;
    shining.light.heightMetres = height;
    return shining;
}

/// Of a point at the origin whose normal is +Z, without the model's 1/pi.
inline double factorOf(const reference::ShiningLight& light, const glm::dvec3& normal = {0, 0, 1},
                       const reference::Settings& settings = {}) {
    return reference::irradianceOf(light, glm::dvec3(0.0), normal, settings).g / std::numbers::pi;
}

} // namespace tessera::test
