#include "scenes/AreaLight.h"

#include <cmath>

namespace tessera::scenes {

bool hasSurface(const Light& light) {
    const auto isThere = [](float metres) { return metres >= kLeastAreaMetres; };
    switch (light.type) {
    case LightType::Rectangle:
        return isThere(light.widthMetres) && isThere(light.heightMetres);
    case LightType::Disk:
    case LightType::Sphere:
        return isThere(light.radiusMetres);
    case LightType::Tube:
        return isThere(light.radiusMetres) && isThere(light.lengthMetres);
    default:
        return false;
    }
}

double largestSeenArea(const Light& light) {
    const double radius = light.radiusMetres, disk = std::numbers::pi * radius * radius;
    switch (light.type) {
    case LightType::Rectangle:
        return double(light.widthMetres) * double(light.heightMetres);
    case LightType::Disk:
    case LightType::Sphere:
        return disk;
    case LightType::Tube:
        // From its side and from its end; what is seen from between is less than both together.
        return 2.0 * radius * double(light.lengthMetres) + disk;
    default:
        return 0.0;
    }
}

double surfaceReachMetres(const Light& light) {
    switch (light.type) {
    case LightType::Rectangle:
        return 0.5 * std::hypot(double(light.widthMetres), double(light.heightMetres));
    case LightType::Disk:
    case LightType::Sphere:
        return light.radiusMetres;
    case LightType::Tube:
        return std::hypot(double(light.radiusMetres), 0.5 * double(light.lengthMetres));
    default:
        return 0.0;
    }
}

std::optional<glm::dvec3> acrossFrom(const glm::dvec3& direction, const glm::dvec3& wish) {
    const double along = glm::dot(wish, direction);
    // A vector that is at right angles but for its rounding keeps every digit.
    if (std::abs(along) < 4e-16) return wish;
    const glm::dvec3 across = wish - along * direction;
    constexpr double kLeastAcross = 1e-6; // of which half of the digits are left
    const double length = glm::length(across);
    if (!(length > kLeastAcross)) return {};
    return across / length;
}

glm::dvec3 usualAlong(const glm::dvec3& directionWS) {
    const glm::dvec3 horizontal = glm::cross(glm::dvec3(0.0, 1.0, 0.0), directionWS);
    constexpr double kVertical = 1e-6; // sine of the angle from the vertical
    const double length = glm::length(horizontal);
    if (length > kVertical) return horizontal / length;
    return acrossFrom(directionWS, {1.0, 0.0, 0.0}).value_or(glm::dvec3(1.0, 0.0, 0.0));
}

} // namespace tessera::scenes
