#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Calls `use` with the corners of every triangle, one after another: counterclockwise seen from the front, also if a
/// node mirrors its mesh.
template <typename Use>
void forEachCornerWS(const Scene& scene, const Use& use) {
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const bool isMirrored = glm::determinant(glm::dmat3(worldFromNode[n])) < 0.0;
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
                const std::uint32_t index = mesh.indices[isMirrored && i % 3 != 0 ? i + 3 - 2 * (i % 3) : i];
                use(glm::dvec3(worldFromNode[n] * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0)));
            }
        }
    }
}

} // namespace tessera::scenes
