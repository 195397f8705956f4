#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Environment.h"

/// An environment filtered beforehand, on the CPU: what a surface sees of it by roughness, and what falls on a surface
/// (docs/environment.md).
namespace tessera::frame {

/// Unit directions on the square of an unfolded octahedron, both coordinates -1..1 (encodeOctahedral() of
/// shaders/lib/maths/octahedral.glsl).
glm::dvec3 directionOf(const glm::dvec2& code);
glm::dvec2 codeOf(const glm::dvec3& direction);

/// Values of all directions at the corners of such a square's side x side cells: side is even, so that the octahedron's
/// edges run along corners. A direction on an outer edge is there twice, at mirrored places of it, and -z four times.
struct DividedOctahedron {
    int side = 0;
    std::vector<glm::vec3> corners; ///< row after row, side + 1 each

    static glm::dvec2 codeOfCorner(int x, int y, int side);
    const glm::vec3& at(int x, int y) const;
};

struct FilteredEnvironment {
    /// The light of a level is averaged by a GGX lobe of alphaOfLevel() around its direction, seen from there, weighted
    /// by the cosine.
    std::vector<DividedOctahedron> levels;
    DividedOctahedron irradiance; ///< on a surface that faces that way, ENVIRONMENT_IRRADIANCE_SIDE
};

inline constexpr int kMostFilteredSide = 1024, kLeastFilteredSide = 32; ///< of filteredSideOf(), and of the last level
inline constexpr int kIrradianceOrder = 32;

/// Side of the square that a map is filtered from, with about as many texels, and the number of levels.
int filteredSideOf(const scenes::Image& map);
int filteredLevelsOf(int side);
/// ENVIRONMENT_LEAST_ALPHA to 1, each the same times the one before.
double alphaOfLevel(int level, int levels);

/// Filters a map on all cores: some seconds for 2048 x 1024 texels. `progress` is called with the share that is done,
/// from any thread.
FilteredEnvironment filterEnvironment(
    const scenes::Image& map, const std::function<void(double)>& progress = [](double) {});

/// Irradiance by spherical harmonics up to an order, which tests compare: kIrradianceOrder is what filterEnvironment()
/// takes. Source: Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps".
DividedOctahedron irradianceOf(const scenes::Image& map, int order, int side);

/// All levels and the irradiance in one picture, a texel for each corner, RGBA; shaders/shared/environment.h says where
/// they lie.
std::vector<glm::vec4> atlasOf(const FilteredEnvironment& filtered);
glm::ivec2 atlasTexels(int side);

} // namespace tessera::frame
