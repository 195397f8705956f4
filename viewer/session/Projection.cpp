#include "viewer/session/Projection.h"

#include <cmath>

namespace tessera::viewer {

std::optional<glm::dvec2> projected(const scenes::Camera& camera, double aspect, const glm::dvec3& positionWS) {
    const glm::dvec3 positionVS(glm::inverse(camera.worldFromCamera) * glm::dvec4(positionWS, 1.0));
    const double depthMetres = -positionVS.z;
    if (depthMetres <= camera.nearMetres) return std::nullopt;
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const double halfHeight =
        isPerspective ? std::tan(0.5 * camera.fovYRadians) * depthMetres : camera.halfHeightMetres;
    return glm::dvec2(0.5 + 0.5 * positionVS.x / (halfHeight * aspect), 0.5 - 0.5 * positionVS.y / halfHeight);
}

} // namespace tessera::viewer
