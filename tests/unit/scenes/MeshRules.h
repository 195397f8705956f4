#pragma once
#include <gtest/gtest.h>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Expects the rules of generated meshes: unit normals, texture coordinates, and triangles that face the side of their
/// vertex normals. Reports the first offender of each kind only.
inline void expectMeshRules(const Mesh& mesh) {
    ASSERT_EQ(mesh.normalsOS.size(), mesh.positionsOS.size()) << mesh.name;
    ASSERT_EQ(mesh.texCoords[0].size(), mesh.positionsOS.size()) << mesh.name;
    for (std::size_t i = 0; i < mesh.normalsOS.size(); ++i) {
        // Three components rounded to single precision.
        ASSERT_NEAR(glm::length(glm::dvec3(mesh.normalsOS[i])), 1.0, 2e-7) << mesh.name << ", normal " << i;
    }
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    ASSERT_FALSE(mesh.indices.empty()) << mesh.name;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::dvec3 a(mesh.positionsOS[mesh.indices[t]]);
        const glm::dvec3 b(mesh.positionsOS[mesh.indices[t + 1]]);
        const glm::dvec3 c(mesh.positionsOS[mesh.indices[t + 2]]);
        const glm::dvec3 front = glm::cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_GT(glm::dot(front, glm::dvec3(mesh.normalsOS[mesh.indices[t + k]])), 0.0)
                << mesh.name << ", triangle " << t / 3 << " at " << a.x << ' ' << a.y << ' ' << a.z;
        }
    }
}

} // namespace tessera::scenes
