#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "validation/lower_bound/LowerBoundBench.h"
#include "validation/lower_bound/LowerBoundLights.h"

namespace tessera::validation {
namespace {

constexpr int kPoint = int(scenes::LightType::Point), kSpot = int(scenes::LightType::Spot),
              kDirectional = int(scenes::LightType::Directional);

frame::PackedLights ofKinds(std::initializer_list<int> kinds) {
    frame::PackedLights lights;
    for (const int kind : kinds) lights.texels.emplace_back().color.w = float(kind);
    return lights;
}

std::map<int, int> countsOf(const frame::PackedLights& lights) {
    std::map<int, int> counts;
    for (const shared::LightTexels& light : lights.texels) ++counts[int(light.color.w)];
    return counts;
}

TEST(LightStores, aUniformBlockIsOneOnlyWhereItMayHoldTheCornersOfPolygons) {
    gpu::Capabilities gl;
    const auto hasUniforms = [&] {
        return std::ranges::count(lightStores(gl), LIGHT_STORE_UNIFORM, &LightStoreInfo::store) == 1;
    };
    gl.maxUniformBlockBytes = 65536;
    EXPECT_TRUE(hasUniforms());
    EXPECT_EQ(lightStores(gl).size(), lightStoreTable().size());
    gl.indexesUniformBlocks = false;
    EXPECT_FALSE(hasUniforms());
    gl.indexesUniformBlocks = true;
    gl.maxUniformBlockBytes = 36 * 1024;
    EXPECT_TRUE(hasUniforms());
    --gl.maxUniformBlockBytes;
    EXPECT_FALSE(hasUniforms());
    gl.maxUniformBlockBytes = 16 * 1024; // what OpenGL 4.5 guarantees
    EXPECT_FALSE(hasUniforms());
    EXPECT_EQ(lightStores(gl).size(), lightStoreTable().size() - 1);
}

TEST(LowerBoundLights, kindsComeInTheSharesOfTheScene) {
    using Counts = std::map<int, int>;
    EXPECT_EQ(countsOf(lowerBoundLights({}, 96)), (Counts{{kPoint, 96}}));
    EXPECT_EQ(countsOf(lowerBoundLights(ofKinds({kSpot, kPoint, kDirectional, kPoint}), 96)),
              (Counts{{kPoint, 48}, {kSpot, 24}, {kDirectional, 24}}));
    // Three quarters of a long list.
    frame::PackedLights many;
    many.texels.resize(1000);
    for (std::size_t i = 0; i < 1000; ++i) many.texels[i].color.w = float(i < 750 ? kSpot : kPoint);
    EXPECT_EQ(countsOf(lowerBoundLights(many, 32)), (Counts{{kSpot, 24}, {kPoint, 8}}));
}

TEST(LowerBoundLights, aListHasTheRequestedLength) {
    for (const int count : {0, 1, 31, 256})
        EXPECT_EQ(lowerBoundLights(ofKinds({kSpot}), count).texels.size(), std::size_t(count));
}

TEST(LowerBoundFigures, theBoundIsGeometryPlusEvaluationsOfTheFastestStore) {
    const LowerBoundFigures figures{
        20.0, {{"uniform buffer", 3.0}, {"texel buffer", 2.0}, {"storage buffer", 5.0}}, {}};
    ASSERT_TRUE(figures.fastestStore());
    EXPECT_EQ(figures.fastestStore()->name, "texel buffer");
    // 1e7 evaluations of 2 ns are 20 ms.
    EXPECT_DOUBLE_EQ(figures.lowerBoundMs(1e7).value(), 40.0);
    EXPECT_EQ(figures.lowerBoundMs(0.0), 20.0);
}

} // namespace
} // namespace tessera::validation
