#include "viewer/edit/Surfaces.h"

#include <algorithm>
#include <cmath>

namespace tessera::viewer {

Surfaces::Surfaces(const scenes::Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        // A mirroring transform reverses the winding of front faces.
        const bool mirrors = glm::determinant(glm::dmat3(worldFromNode[n])) < 0.0;
        for (const scenes::MeshInstance& instance : scene.nodes[n].instances) {
            const scenes::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            const auto cornerWS = [&](std::size_t i) {
                return glm::dvec3(worldFromNode[n] * glm::dvec4(glm::dvec3(mesh.positionsOS[mesh.indices[i]]), 1.0));
            };
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const glm::dvec3 a = cornerWS(i);
                glm::dvec3 first = cornerWS(i + 1) - a, second = cornerWS(i + 2) - a;
                if (mirrors) std::swap(first, second);
                const glm::dvec3 normal = glm::cross(first, second);
                const double length = glm::length(normal);
                if (!(length > 0.0) || !std::isfinite(length)) continue;
                triangles_.push_back({a, first, second});
            }
        }
    }
    double sum = 0.0;
    for (const Triangle& triangle : triangles_) {
        sum += 0.5 * glm::length(glm::cross(triangle.firstEdge, triangle.secondEdge));
        areaSums_.push_back(sum);
    }
}

Surfaces::Place Surfaces::at(double triangle, double u, double v) const {
    const auto found = std::ranges::upper_bound(areaSums_, triangle * areaSums_.back());
    const auto index = std::min(std::size_t(found - areaSums_.begin()), areaSums_.size() - 1);
    const Triangle& chosen = triangles_[index];
    if (u + v > 1.0) { // the other half of the parallelogram, folded back
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {chosen.cornerWS + u * chosen.firstEdge + v * chosen.secondEdge,
            glm::normalize(glm::cross(chosen.firstEdge, chosen.secondEdge))};
}

} // namespace tessera::viewer
