#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "scenes/Scene.h"

/// Lights that reach a position, ignoring surfaces.
namespace tessera::viewer {

/// Index of the enabled light with the highest illuminance at a position and a time; none if no light reaches it.
std::optional<int> brightestAt(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS,
                               double timeSeconds);

/// Number of enabled lights that reach it: within their range and cone, with colour and intensity.
std::size_t lightsReaching(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS, double timeSeconds);

} // namespace tessera::viewer
