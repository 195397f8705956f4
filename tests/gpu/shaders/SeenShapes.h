#pragma once
#include <array>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "tests/gpu/shaders/ShaderBench.h"

/// Area lights around a shading point, and the fraction of a lobe they cover: by shaders, and by integrals in double.
namespace tessera::test {

/// A light as in LightShapeTexels, in metres from the shading point. The rounded floats define the light exactly.
struct SeenShape {
    scenes::LightType type = scenes::LightType::Rectangle;
    glm::vec3 middle{0.0f};
    glm::vec3 first{0.0f}; ///< half of a rectangle's side or a tube's length, a disk's radius
    float radius = 0.0f;   ///< of a tube
    glm::vec3 second{0.0f};
    bool isTwoSided = true;
    std::vector<glm::vec2> corners{}; ///< of a polygon, counterclockwise, in units of `first` and `second`
    int picture = -1;                 ///< index of a bound image, or -1
};

/// Transforms to a clamped cosine around z: for a matte surface, and for tilted and narrow lobes.
extern const std::array<glm::mat3, 3> kCosineMatrices;

/// The fraction of such a lobe that a light covers, by an integral over its surface. At most a negligible part of the
/// light may be below the horizon of surface or cosine.
double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface);
/// The same for a flat light with a radiance factor: a function of the position in units of `first` and `second`.
double shareByQuadrature(const SeenShape& shape, const glm::mat3& cosineFromSurface,
                         const std::function<double(double, double)>& factor);

struct SeenByShader {
    double share = 0.0;
    glm::dvec3 pictureFactor{1.0};
};
/// Computed by lib/light/area_light.glsl.
std::vector<SeenByShader> seenByShader(ShaderBench& bench, const std::vector<SeenShape>& shapes,
                                       const glm::mat3& cosineFromSurface);

} // namespace tessera::test
