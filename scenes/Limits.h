#pragma once
#include <cmath>
#include <string>

#include "scenes/Scene.h"

/// How many lights a scene may have and how far lengths may go (kFarthestMetres of scenes/Camera.h).
namespace tessera::scenes {

/// The most lights that a scene can have. Software rasterisers end loops early, and shaders cannot visit more
/// (renderer/frame/LightRounds.h).
inline constexpr int kMostLights = 262144;

/// Throws InputError when these lights are more than kMostLights; `source` is the file that gives them, or the scene.
void requireDrawableLights(const std::string& source, std::size_t lights);

/// The most materials with a subsurface that a scene can have: pixels name theirs in 8 bits.
inline constexpr int kMostSubsurfaces = 255;

inline constexpr std::size_t kMostNameBytes = 4096; ///< of a scene or anything in it; messages and tables show names

/// Whether a place in the world lies within the limits.
inline bool isNearEnough(const glm::dvec3& positionWS) {
    const auto isWithin = [](double coordinate) { return std::abs(coordinate) <= kFarthestMetres; };
    return isWithin(positionWS.x) && isWithin(positionWS.y) && isWithin(positionWS.z);
}

/// A message on the value of a camera, of finite numbers, that exceeds the limits, with the remedy; empty if none does.
std::string limitProblem(const Camera& camera);

} // namespace tessera::scenes
