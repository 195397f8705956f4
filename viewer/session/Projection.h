#pragma once
#include <optional>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// Where a point is in a picture of this aspect (width over height), as shares of its size from the upper left; none
/// where it lies behind the camera. Shares beyond 0 to 1 are outside the picture.
std::optional<glm::dvec2> projected(const scenes::Camera& camera, double aspect, const glm::dvec3& positionWS);

} // namespace tessera::viewer
