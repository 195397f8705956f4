#pragma once
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/DividedOctahedron.h"
#include "scenes/Environment.h"

/// A prefiltered environment, computed on the CPU: radiance by roughness, and irradiance (docs/environment.md).
namespace tessera::frame {

struct FilteredEnvironment {
    /// Each level is the radiance averaged over a GGX lobe of alphaOfLevel() with the view along the normal, weighted
    /// by the cosine.
    std::vector<DividedOctahedron> levels;
    DividedOctahedron irradiance; ///< by surface normal; side ENVIRONMENT_IRRADIANCE_SIDE
};

/// A sample of a lobe around +z.
struct LobeSample {
    glm::vec3 direction;
    float weight;
    int level;   ///< source level whose texel spacing matches that of the samples
    float share; ///< weight of the next level
};

/// Samples D's lobe with the normal as view direction (Karis 2013), with levels as in Krivanek and Colbert 2008,
/// "Real-time Shading with Filtered Importance Sampling". `levels` source levels halve an octahedral map of
/// `sourceSide` texels a side. Half a level is added, so that texels of neighbouring samples overlap.
std::vector<LobeSample> lobeSamples(double alpha, int count, int sourceSide, int levels);

/// log2 of ENVIRONMENT_MOST_SIDE / side of the octahedral map that a map is filtered from. The octahedral map has about
/// as many texels as the map, but at least 128 along a side.
int filteredHalvingsOf(const scenes::Image& map);
/// GGX alpha of a level: a geometric series from ENVIRONMENT_LEAST_ALPHA to 1.
double alphaOfLevel(int level);

/// Filters a map on all cores: some seconds for 2048 x 1024 texels. `progress` is called with the completed fraction,
/// from any thread; an exception from it aborts the work and is rethrown.
FilteredEnvironment filterEnvironment(
    const scenes::Image& map, const std::function<void(double)>& progress = [](double) {});

/// All levels and the irradiance in one RGBA image, one texel per corner; layout in shaders/shared/environment.h.
std::vector<glm::vec4> atlasOf(const FilteredEnvironment& filtered);
glm::ivec2 atlasTexels(int halvings);

} // namespace tessera::frame
