#pragma once
#include <optional>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// A triangle of what a scene draws.
struct Pick {
    int node = scenes::kNone;
    int instance = scenes::kNone; ///< of the node
    int mesh = scenes::kNone;
    int material = scenes::kNone;
    int triangle = scenes::kNone; ///< of the mesh
    glm::dvec3 positionWS{0.0};   ///< where the pixel shows it
    glm::dvec3 normalWS{0.0};     ///< that is lit there, as the view `normal` shows it
};

/// The nearest surface, transparent ones too, that a camera shows at a pixel; rows count from the top. By rays in
/// double precision, without a picture of it: alpha masks, sides and clip planes count as in the picture. Takes about
/// as long as one look at every triangle. Throws std::runtime_error when memory runs out.
std::optional<Pick> pickedByRay(const scenes::Scene& scene, const scenes::Camera& camera, glm::ivec2 sizePixels,
                                glm::ivec2 pixel);

} // namespace tessera::viewer
