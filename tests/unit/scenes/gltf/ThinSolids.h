#pragma once
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/import/GltfSteps.h"
#include "tests/unit/scenes/gltf/AnimationBuilder.h"

/// glTF files of points and lines, and the solids made from them.
namespace tessera::scenes::gltf::test {

/// The longest side of their bounds is 2.
inline const std::vector<float> kFivePlaces{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

/// A builder whose primitive has this mode and these positions.
inline Builder thin(int mode, const std::vector<float>& positions = kFivePlaces) {
    Builder builder;
    builder.attribute("POSITION", "VEC3", positions);
    builder.primitive()["mode"] = mode;
    return builder;
}

inline void addNormals(Builder& builder, std::size_t count) {
    builder.attribute("NORMAL", "VEC3", std::vector<float>(3 * count, 1.0f));
}

inline glm::dvec3 cornerOS(const Mesh& mesh, std::size_t i) {
    return glm::dvec3(mesh.positionsOS.at(mesh.indices.at(i)));
}

/// Volume of a closed solid, positive if its triangles face outwards. Expects each normal to be its triangle's.
inline double volumeOf(const Mesh& mesh, std::size_t solid) {
    double volume = 0.0;
    for (std::size_t i = solid * kCornersOfSolid; i < (solid + 1) * kCornersOfSolid; i += 3) {
        const glm::dvec3 a = cornerOS(mesh, i), b = cornerOS(mesh, i + 1), c = cornerOS(mesh, i + 2);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k)
            // Rounding of positions by 6e-8 of the bounds is below 1e-4 of a solid's width, 2.5e-3 of the bounds.
            EXPECT_GT(glm::dot(glm::dvec3(mesh.normalsOS.at(mesh.indices.at(i + k))), normal), 1.0 - 1e-3) << i;
    }
    return volume;
}

inline const Material& materialOf(const Scene& scene, std::size_t instance = 0) {
    return scene.materials.at(std::size_t(scene.nodes.at(0).instances.at(instance).material));
}

} // namespace tessera::scenes::gltf::test
