#pragma once
#include <cmath>
#include <string>

#include "scenes/Scene.h"

/// Limits on the number of lights and on lengths (kFarthestMetres of scenes/Camera.h).
namespace tessera::scenes {

/// Maximum number of lights in a scene. Software rasterisers truncate loops, and shaders cannot visit more
/// (renderer/frame/LightRounds.h).
inline constexpr int kMostLights = 262144;

/// Throws InputError if there are more than kMostLights; `source` is the lights' file, or the scene.
void requireDrawableLights(const std::string& source, std::size_t lights);

/// Maximum number of materials with subsurface scattering: pixels store their index in 8 bits.
inline constexpr int kMostSubsurfaces = 255;

inline constexpr std::size_t kMostNameBytes = 4096; ///< maximum name length in a scene; messages and tables show names

/// Whether a world position lies within kFarthestMetres along each axis.
inline bool isNearEnough(const glm::dvec3& positionWS) {
    const auto isWithin = [](double coordinate) { return std::abs(coordinate) <= kFarthestMetres; };
    return isWithin(positionWS.x) && isWithin(positionWS.y) && isWithin(positionWS.z);
}

/// Describes a camera value that exceeds the limits, with the remedy; empty if none does. All values must be finite.
std::string limitProblem(const Camera& camera);

} // namespace tessera::scenes
