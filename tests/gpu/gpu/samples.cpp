#include <gtest/gtest.h>

#include "renderer/gpu/Framebuffer.h"
#include "renderer/gpu/Texture.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

using graph::Format;

class Samples : public test::GlTest {};

TEST_F(Samples, everyNumberThatIsOfferedMakesRenderTargets) {
    const std::vector<std::vector<glm::vec2>>& given = context().capabilities().samplePlaces;
    ASSERT_FALSE(given.empty());
    EXPECT_EQ(given.front(), std::vector<glm::vec2>{glm::vec2(0.5f)});
    EXPECT_TRUE(std::ranges::is_sorted(given, {}, &std::vector<glm::vec2>::size));
    EXPECT_GE(given.back().size(), 4u) << "OpenGL 4.5 requires 4 samples of colour textures (table 23.66)";
    for (const std::vector<glm::vec2>& positions : given) {
        const int samples = int(positions.size());
        SCOPED_TRACE(samples);
        const Texture color("color", {Format::Rgba32Float, 5, 3, samples});
        const Texture shadingDepth("shading depth", {Format::R32Float, 5, 3, samples});
        const Texture depth("depth", {Format::Depth32Float, 5, 3, samples});
        EXPECT_NO_THROW(Framebuffer({{&shadingDepth}, &depth}));
        EXPECT_NO_THROW(Framebuffer({{&color}, &depth}));
        for (std::size_t i = 0; i < positions.size(); ++i) {
            EXPECT_TRUE(positions[i].x >= 0.0f && positions[i].x < 1.0f) << i; // NVIDIA has some of 16 on an edge
            EXPECT_TRUE(positions[i].y >= 0.0f && positions[i].y < 1.0f) << i;
            for (std::size_t j = 0; j < i; ++j) EXPECT_NE(positions[i], positions[j]);
        }
    }
}

} // namespace
} // namespace tessera::gpu
