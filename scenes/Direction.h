#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/glm.hpp>

namespace tessera::scenes {

/// The vector at unit length; nothing where it is zero or not finite. Scaled first, so that squares of large and small
/// components neither overflow nor vanish.
inline std::optional<glm::dvec3> directionOf(const glm::dvec3& vector) {
    const glm::dvec3 size = glm::abs(vector);
    const double largest = std::max({size.x, size.y, size.z});
    const bool isFinite = std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
    if (!isFinite || !(largest > 0.0)) return {};
    return glm::normalize(vector / largest);
}

} // namespace tessera::scenes
