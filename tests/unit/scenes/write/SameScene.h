#pragma once
#include <filesystem>

#include <gtest/gtest.h>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Expects two scenes to be equal field by field, to the last bit; warnings are not compared.
inline void expectSameScene(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.background, b.background);
    EXPECT_TRUE(a.materials == b.materials);
    EXPECT_TRUE(a.lights == b.lights);
    EXPECT_TRUE(a.cameras == b.cameras);
    EXPECT_TRUE(a.options == b.options);
    ASSERT_EQ(a.images.size(), b.images.size());
    for (std::size_t i = 0; i < a.images.size(); ++i) {
        // An image's name is the path to its file, relative to the scene's.
        EXPECT_EQ(std::filesystem::weakly_canonical(a.images[i].name),
                  std::filesystem::weakly_canonical(b.images[i].name));
        EXPECT_EQ(a.images[i].format, b.images[i].format);
        EXPECT_EQ(a.images[i].width, b.images[i].width);
        EXPECT_EQ(a.images[i].height, b.images[i].height);
        EXPECT_TRUE(a.images[i].texels == b.images[i].texels) << "image " << i;
    }
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        const Mesh &m = a.meshes[i], &n = b.meshes[i];
        EXPECT_TRUE(m.name == n.name && m.positionsOS == n.positionsOS && m.normalsOS == n.normalsOS &&
                    m.tangentsOS == n.tangentsOS && m.texCoords == n.texCoords && m.colors == n.colors &&
                    m.indices == n.indices)
            << "mesh " << i;
    }
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        const Node &m = a.nodes[i], &n = b.nodes[i];
        EXPECT_TRUE(m.name == n.name && m.parent == n.parent && m.parentFromNode == n.parentFromNode) << "node " << i;
        ASSERT_EQ(m.instances.size(), n.instances.size());
        for (std::size_t j = 0; j < m.instances.size(); ++j)
            EXPECT_TRUE(m.instances[j].mesh == n.instances[j].mesh &&
                        m.instances[j].material == n.instances[j].material);
    }
}

} // namespace tessera::scenes
