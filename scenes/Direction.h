#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/glm.hpp>

namespace tessera::scenes {

/// Normalises a vector; nothing if it is zero or not finite. Scales it first, so that squares of large and small
/// components neither overflow nor underflow.
inline std::optional<glm::dvec3> directionOf(const glm::dvec3& vector) {
    const glm::dvec3 size = glm::abs(vector);
    const double largest = std::max({size.x, size.y, size.z});
    const bool isFinite = std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
    if (!isFinite || !(largest > 0.0)) return {};
    return glm::normalize(vector / largest);
}

/// Unit normal by the order of the corners; +Z for triangles without area.
inline glm::dvec3 normalOfTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return directionOf(glm::cross(b - a, c - a)).value_or(glm::dvec3(0.0, 0.0, 1.0));
}

} // namespace tessera::scenes
