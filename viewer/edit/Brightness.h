#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "scenes/Scene.h"

/// Which lights shine on a place, without regard to surfaces.
namespace tessera::viewer {

/// The index of the light that lights a place most at a time, of those that are on; none where none does.
std::optional<int> brightestAt(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS,
                               double timeSeconds);

/// How many of those that are on reach it: closer than their range, inside their cone, with colour and intensity.
std::size_t lightsReaching(const std::vector<scenes::Light>& lights, const glm::dvec3& positionWS, double timeSeconds);

} // namespace tessera::viewer
