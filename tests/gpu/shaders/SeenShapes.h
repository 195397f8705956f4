#pragma once
#include <array>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "tests/gpu/shaders/ShaderBench.h"

/// Area lights as a point sees them, and what a lobe sees of them: by shaders, and by integrals in double.
namespace tessera::test {

/// As LightShapeTexels; metres, and from the point. What rounding to floats leaves of it is the light itself.
struct SeenShape {
    scenes::LightType type = scenes::LightType::Rectangle;
    glm::vec3 middle{0.0f};
    glm::vec3 first{0.0f}; ///< half of a rectangle's side or a tube's length, a disk's radius
    float radius = 0.0f;   ///< of a tube
    glm::vec3 second{0.0f};
    bool isTwoSided = true;
    std::vector<glm::vec2> corners{}; ///< of a polygon, counterclockwise: in parts of `first` and `second`
    int picture = -1;                 ///< of those that are bound, or none
};

/// To a clamped cosine around z: a matte surface, and lobes that lean and are narrow.
extern const std::array<glm::mat3, 3> kCosineMatrices;

/// The share of such a lobe that each light fills, by an integral over its surface: all of the light above the horizon
/// of surface and cosine, or next to nothing of it below.
double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface);
/// The same of a flat light whose places count by a factor, given in parts of `first` and `second`.
double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface,
                         const std::function<double(double, double)>& factor);

struct SeenByShader {
    double share = 0.0;
    glm::dvec3 pictureFactor{1.0};
};
/// By lib/light/area_light.glsl.
std::vector<SeenByShader> seenByShader(ShaderBench& bench, const std::vector<SeenShape>& shapes,
                                       const glm::mat3& cosineFromSurface);

} // namespace tessera::test
