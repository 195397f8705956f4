#include "renderer/frame/DepthInterval.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::frame {

namespace {

std::array<glm::dvec3, 8> cornersOf(const scenes::Box3& box) {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[std::size_t(i)] = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                   (i & 4) != 0 ? box.max.z : box.min.z};
    return corners;
}

/// What a camera sees of the bounds, as far as boxes tell.
struct Seen {
    double nearest = std::numeric_limits<double>::infinity(); ///< along the view axis
    double farthest = -std::numeric_limits<double>::infinity();
    double across = 0.0; ///< from the view axis
    double reach = 0.0;  ///< the largest SurfaceBounds::reachMetres
};

/// Boxes just outside a side of the picture, by this share of their distance from the view axis, are taken in too:
/// rounding to fp32 may move what they hold into the picture.
constexpr double kSideMargin = 1e-4;

void addBox(Seen& seen, const SurfaceBounds& bounds, const scenes::Camera& camera, const glm::dvec2& halfExtent) {
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const glm::dmat3 viewFromWorld = glm::inverse(glm::dmat3(camera.worldFromCamera));
    std::array<glm::dvec3, 8> cornersVS;
    std::array<glm::dvec3, 8> cornersWS = cornersOf(bounds.boxWS);
    std::transform(cornersWS.begin(), cornersWS.end(), cornersVS.begin(), [&](const glm::dvec3& cornerWS) {
        return viewFromWorld * (cornerWS - glm::dvec3(camera.worldFromCamera[3]));
    });
    for (const double side : {-1.0, 1.0}) {
        for (int axis = 0; axis < 2; ++axis) {
            const auto isOutside = [&](const glm::dvec3& cornerVS) {
                const double edge = halfExtent[axis] * (isPerspective ? -cornerVS.z : 1.0);
                return side * cornerVS[axis] > edge + kSideMargin * glm::length(glm::dvec2(cornerVS));
            };
            if (std::all_of(cornersVS.begin(), cornersVS.end(), isOutside)) return;
        }
    }
    const auto [farthest, nearest] = std::minmax_element(
        cornersVS.begin(), cornersVS.end(), [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
    if (-farthest->z < camera.nearMetres || -nearest->z > camera.farMetres) return;
    seen.nearest = std::min(seen.nearest, -nearest->z);
    seen.farthest = std::max(seen.farthest, -farthest->z);
    for (const glm::dvec3& cornerVS : cornersVS) seen.across = std::max(seen.across, glm::length(glm::dvec2(cornerVS)));
    seen.reach = std::max(seen.reach, bounds.reachMetres);
}

DepthInterval ownInterval(const scenes::Camera& camera) {
    DepthInterval own{camera.nearMetres, camera.farMetres, 0.0, false};
    own.isEven = camera.projection == scenes::Projection::Orthographic;
    // The depth of parallel rays cannot reach infinity.
    if (own.isEven && std::isinf(own.farMetres)) own.farMetres = own.nearMetres + 2000.0 * camera.halfHeightMetres;
    return own;
}

} // namespace

std::vector<SurfaceBounds> surfaceBounds(const scenes::Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    std::vector<SurfaceBounds> all;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            const scenes::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            SurfaceBounds bounds;
            for (const std::uint32_t index : mesh.indices)
                bounds.boxWS.extend(
                    glm::dvec3(worldFromNode[node] * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0)));
            if (bounds.boxWS.empty()) continue;
            for (const glm::dvec3& corner : cornersOf(bounds.boxWS))
                bounds.reachMetres =
                    std::max(bounds.reachMetres, glm::distance(corner, glm::dvec3(worldFromNode[node][3])));
            all.push_back(bounds);
        }
    }
    return all;
}

DepthInterval depthInterval(const scenes::Camera& camera, const glm::dvec2& halfExtent,
                            std::span<const SurfaceBounds> bounds) {
    DepthInterval interval = ownInterval(camera);
    Seen seen;
    for (const SurfaceBounds& one : bounds) addBox(seen, one, camera, halfExtent);
    if (!(seen.nearest <= seen.farthest)) return interval;

    // Room for what rounds: positions relative to the middle, and vertices relative to their nodes. With several
    // samples a pixel a surface is also lit a little beyond its edges, at the depth that it would have there.
    const double span = seen.farthest - seen.nearest;
    const double room = span / 8.0 + 1e-3 * (span + seen.across) + 1e-6 * seen.reach;
    const double nearMetres = std::max(camera.nearMetres, seen.nearest - room);
    const double farMetres = std::min(camera.farMetres, seen.farthest + room);
    const bool isOrthographic = camera.projection == scenes::Projection::Orthographic;
    if (!(farMetres > nearMetres) || !std::isfinite(farMetres)) return interval;
    if (!isOrthographic && farMetres > 2.0 * nearMetres) return interval;
    interval.nearMetres = nearMetres;
    interval.farMetres = farMetres;
    interval.originMetres = 0.5 * (nearMetres + farMetres);
    interval.isEven = true;
    return interval;
}

} // namespace tessera::frame
