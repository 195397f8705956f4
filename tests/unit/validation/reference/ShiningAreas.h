#pragma once
#include <numbers>

#include "scenes/AreaLight.h"
#include "validation/reference/AreaLights.h"

/// Area lights for the reference's integrals, and their configuration factors.
namespace tessera::test {

/// Relative error of the default cubature. Rules that differ by 2e-5 are themselves wrong by a few times 1e-6, mostly
/// where the horizon cuts a light.
inline constexpr double kCubature = 2e-5;

/// An area light of radiance 1 without a range.
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

/// Configuration factor of a light at the origin: its irradiance at radiance 1, over pi.
inline double factorOf(const reference::ShiningLight& light, const glm::dvec3& normal = {0, 0, 1},
                       const reference::Settings& settings = {}) {
    return reference::irradianceOf(light, glm::dvec3(0.0), normal, settings).g / std::numbers::pi;
}

} // namespace tessera::test
