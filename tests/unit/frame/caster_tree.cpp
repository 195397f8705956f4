#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/frame/CasterTree.h"
#include "scenes/Load.h"
#include "scenes/Shadows.h"
#include "tests/support/TestScenes.h"

namespace tessera::frame {
namespace {

CasterTree treeOf(const scenes::Scene& scene) {
    return makeCasterTree(scene);
}

glm::vec3 place(const glm::uvec4& texel) {
    return glm::uintBitsToFloat(glm::uvec3(texel));
}

/// Triangles found by a walk that enters every box.
struct Met {
    std::size_t triangles = 0, masked = 0;
};
/// Expects boxes to enclose the nodes below them, and a walk to visit each node once.
Met walkAll(const CasterTree& tree) {
    Met met;
    std::uint32_t node = 0;
    std::vector<std::uint32_t> open; ///< nodes whose boxes enclose the next node
    while (node < tree.space.nodes) {
        const glm::uvec4 low = tree.texels[2 * node], high = tree.texels[2 * node + 1];
        EXPECT_GT(low.w, node);
        EXPECT_LE(low.w, tree.space.nodes);
        while (!open.empty() && tree.texels[2 * open.back()].w <= node) open.pop_back();
        open.push_back(node);
        if (high.w != 0) {
            EXPECT_EQ(low.w, node + 1) << "nothing lies below a leaf";
            const bool isMasked = shared::isCasterLeafMasked(high.w);
            const std::uint32_t stride = isMasked ? CASTER_MASKED_TRIANGLE_TEXELS : CASTER_TRIANGLE_TEXELS;
            for (std::uint32_t i = 0; i < shared::casterLeafTriangles(high.w); ++i) {
                ++met.triangles;
                met.masked += isMasked;
                for (std::uint32_t corner = 0; corner < 3; ++corner) {
                    const glm::vec3 at = place(tree.texels[shared::casterLeafTexel(high.w) + i * stride + corner]);
                    for (const std::uint32_t box : open) {
                        EXPECT_TRUE(glm::all(glm::lessThanEqual(place(tree.texels[2 * box]), at)));
                        EXPECT_TRUE(glm::all(glm::greaterThanEqual(place(tree.texels[2 * box + 1]), at)));
                    }
                }
            }
        }
        ++node;
    }
    return met;
}

TEST(CasterTree, holdsEveryTriangleOfEveryCasterInTheBoxesAboveIt) {
    const scenes::Scene scene = test::everythingScene();
    const Met met = walkAll(treeOf(scene));
    EXPECT_GT(met.masked, 0u);
    EXPECT_LT(met.masked, met.triangles);
    // Triangles at a sphere's poles have no area and are missing.
    EXPECT_LE(met.triangles, scenes::casterCounts(scene).triangles);
    EXPECT_GE(met.triangles, scenes::casterCounts(scene).triangles * 9 / 10);
}

TEST(CasterTree, isEmptyWithoutCastersAndWithoutArea) {
    scenes::Scene scene = test::quadScene({});
    EXPECT_EQ(walkAll(treeOf(scene)).triangles, 2u);
    scene.nodes[0].parentFromNode[0] = glm::dvec4(0.0);
    EXPECT_EQ(treeOf(scene).space.nodes, 0u) << "pressed to a line";
    scene = test::quadScene({});
    scene.materials[0].castsShadow = false;
    EXPECT_EQ(treeOf(scene).space.nodes, 0u);
    EXPECT_TRUE(treeOf(scene).texels.empty());
}

TEST(CasterTree, leavesArePackedToTheLastBit) {
    for (const std::uint32_t texel : {0u, 5u, (1u << CASTER_LEAF_TEXEL_BITS) - 1u}) {
        for (std::uint32_t triangles = 1; triangles <= CASTER_LEAF_MOST; ++triangles) {
            for (const bool isMasked : {false, true}) {
                if (texel == 0 && triangles == 1 && !isMasked) continue; // 0 is no leaf; nodes come before triangles
                const std::uint32_t leaf = shared::packCasterLeaf(texel, triangles, isMasked);
                EXPECT_NE(leaf, 0u);
                EXPECT_EQ(shared::casterLeafTexel(leaf), texel);
                EXPECT_EQ(shared::casterLeafTriangles(leaf), triangles);
                EXPECT_EQ(shared::isCasterLeafMasked(leaf), isMasked);
            }
        }
    }
}

} // namespace
} // namespace tessera::frame
