#include "viewer/edit/Clearance.h"

#include <algorithm>

namespace tessera::viewer {
namespace {

scenes::Camera cameraIn(const scenes::Box3& boundsWS) {
    scenes::Camera camera;
    camera.projection = scenes::Projection::Orthographic; // parallel rays have no minimum distance
    camera.nearMetres = 0.0;
    if (boundsWS.empty()) return camera;
    camera.worldFromCamera[3] = glm::dvec4(0.5 * (boundsWS.min + boundsWS.max), 1.0);
    camera.farMetres = 2.0 * glm::length(boundsWS.max - boundsWS.min) + 1.0;
    return camera;
}

} // namespace

Clearance::Clearance(const scenes::Scene& scene)
    : rays_(cameraIn(scenes::worldBounds(scene)), {1, 1}), objects_(scene, rays_),
      textures_(scene, reference::Filtering::Exact), visibility_(objects_, rays_, textures_) {}

std::optional<double> Clearance::metresAlong(const glm::dvec3& placeWS, const glm::dvec3& directionWS,
                                             double mostMetres, double leastMetres) const {
    const double startMetres = leastMetres > 0.0 ? leastMetres : 1e-4 * mostMetres;
    const reference::Ray ray{placeWS + startMetres * directionWS - rays_.eyeWS(), directionWS};
    const std::optional<reference::Hit> hit = visibility_.nearestOpaqueAhead(ray);
    if (!hit || startMetres + hit->depthMetres > mostMetres) return std::nullopt;
    return startMetres + hit->depthMetres;
}

std::optional<double> Clearance::metresAround(const glm::dvec3& placeWS, double mostMetres) const {
    std::optional<double> nearest;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const auto metres = metresAlong(placeWS, glm::normalize(glm::dvec3(x, y, z)), mostMetres);
                if (metres) nearest = std::min(*metres, nearest.value_or(*metres));
            }
    return nearest;
}

} // namespace tessera::viewer
