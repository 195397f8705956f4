#pragma once
#include <optional>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// A picked triangle of a scene.
struct Pick {
    int node = scenes::kNone;
    int instance = scenes::kNone; ///< of the node
    int mesh = scenes::kNone;
    int material = scenes::kNone;
    int triangle = scenes::kNone; ///< of the mesh
    glm::dvec3 positionWS{0.0};   ///< surface point at the pixel
    glm::dvec3 normalWS{0.0};     ///< shading normal there, as in the view `normal`
};

/// The nearest surface, including transparent ones, that a camera shows at a pixel; rows count from the top. Uses rays
/// in double precision instead of an image, with the same alpha masks, sides and clip planes. Takes about one pass over
/// all triangles. Throws std::runtime_error when memory runs out.
std::optional<Pick> pickedByRay(const scenes::Scene& scene, const scenes::Camera& camera, glm::ivec2 sizePixels,
                                glm::ivec2 pixel);

} // namespace tessera::viewer
