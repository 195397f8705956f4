#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Calls `use` with every vertex that a triangle uses, three of a triangle after one another.
template <typename Use>
void forEachCornerWS(const Scene& scene, const Use& use) {
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
            for (const std::uint32_t index : mesh.indices)
                use(glm::dvec3(worldFromNode[n] * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0)));
        }
}

} // namespace tessera::scenes
