#pragma once
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/DividedOctahedron.h"
#include "scenes/Environment.h"

/// An environment filtered beforehand, on the CPU: what a surface sees of it by roughness, and what falls on a surface
/// (docs/environment.md).
namespace tessera::frame {

struct FilteredEnvironment {
    /// The light of a level is averaged by a GGX lobe of alphaOfLevel() around its direction, seen from there, weighted
    /// by the cosine.
    std::vector<DividedOctahedron> levels;
    DividedOctahedron irradiance; ///< on a surface that faces that way, ENVIRONMENT_IRRADIANCE_SIDE
};

/// By how many halvings the square that a map is filtered from is smaller than ENVIRONMENT_MOST_SIDE, so that it has
/// about as many texels, but not fewer than 128 along a side.
int filteredHalvingsOf(const scenes::Image& map);
/// ENVIRONMENT_LEAST_ALPHA to 1, each the same times the one before.
double alphaOfLevel(int level);

/// Filters a map on all cores: some seconds for 2048 x 1024 texels. `progress` is called with the share that is done,
/// from any thread; what it throws ends the work, and is thrown.
FilteredEnvironment filterEnvironment(
    const scenes::Image& map, const std::function<void(double)>& progress = [](double) {});

/// All levels and the irradiance in one picture, a texel for each corner, RGBA; shaders/shared/environment.h says where
/// they lie.
std::vector<glm::vec4> atlasOf(const FilteredEnvironment& filtered);
glm::ivec2 atlasTexels(int halvings);

} // namespace tessera::frame
