#include "renderer/frame/VertexStreams.h"

#include <gmock/gmock.h>

#include "renderer/frame/Tangents.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::frame {
namespace {

using testing::Each;
using testing::ElementsAre;

/// A bare triangle and one with every attribute.
scenes::Scene twoMeshes() {
    scenes::Scene scene = scenes::tinyScene();
    scenes::Mesh& full = scene.meshes.emplace_back(scene.meshes[0]);
    full.indices = {2, 1, 0};
    full.texCoords[0] = {{0, 1}, {1, 1}, {0, 0}};
    full.texCoords[1] = {{0.25f, 0}, {0.5f, 0}, {0.75f, 0}};
    full.colors.assign(3, glm::vec4(0.5f));
    full.tangentsOS.assign(3, {0, 1, 0, -1});
    scene.nodes[0].instances.push_back({1, 0});
    return scene;
}

TEST(VertexStreams, meshesAlwaysLieEndToEnd) {
    const VertexStreams streams = makeVertexStreams(twoMeshes(), allFeatures());
    ASSERT_EQ(streams.ranges.size(), 2u);
    EXPECT_EQ(streams.ranges[0].firstIndex, 0u);
    EXPECT_EQ(streams.ranges[1].firstIndex, 3u);
    EXPECT_EQ(streams.ranges[1].indexCount, 3u);
    EXPECT_EQ(streams.ranges[1].baseVertex, 3);
    EXPECT_THAT(streams.indices, ElementsAre(0, 1, 2, 2, 1, 0));
    EXPECT_EQ(streams.positionsOS.size(), 6u);
    EXPECT_EQ(streams.positionsOS[5], glm::vec3(0, 4, 0));
}

TEST(VertexStreams, aMeshThatNothingDrawsIsNeverThere) {
    scenes::Scene scene = twoMeshes();
    scene.nodes[0].instances.erase(scene.nodes[0].instances.begin());
    const VertexStreams streams = makeVertexStreams(scene, allFeatures());
    ASSERT_EQ(streams.ranges.size(), 2u);
    EXPECT_EQ(streams.ranges[0].indexCount, 0u);
    EXPECT_EQ(streams.ranges[1].firstIndex, 0u);
    EXPECT_EQ(streams.ranges[1].baseVertex, 0);
    EXPECT_EQ(streams.positionsOS.size(), 3u);
}

TEST(VertexStreams, missingAttributesAlwaysGetTheirNeutralValue) {
    const VertexStreams streams = makeVertexStreams(twoMeshes(), allFeatures());
    const auto expectStream = [](const auto& stream, const auto& neutral, const auto& last) {
        ASSERT_EQ(stream.size(), 6u);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(stream[i], neutral);
        EXPECT_EQ(stream[5], last);
    };
    expectStream(streams.colors, glm::vec4(1.0f), glm::vec4(0.5f));
    expectStream(streams.texCoords[0], glm::vec2(0.0f), glm::vec2(0, 0));
    expectStream(streams.texCoords[1], glm::vec2(0.0f), glm::vec2(0.75f, 0));
    expectStream(streams.tangentsOS, glm::vec4(1, 0, 0, 1), glm::vec4(0, 1, 0, -1));
}

TEST(VertexStreams, streamsThatNothingNeedsAreAlwaysEmpty) {
    const VertexStreams streams = makeVertexStreams(twoMeshes(), FeatureSet{});
    EXPECT_EQ(streams.positionsOS.size(), 6u);
    EXPECT_EQ(streams.normalsOS.size(), 6u);
    EXPECT_TRUE(streams.tangentsOS.empty() && streams.texCoords[0].empty() && streams.texCoords[1].empty() &&
                streams.colors.empty());
    FeatureSet textured;
    textured.add(Feature::BaseColorTexture);
    EXPECT_EQ(makeVertexStreams(twoMeshes(), textured).texCoords[0].size(), 6u);
    EXPECT_TRUE(makeVertexStreams(twoMeshes(), textured).texCoords[1].empty());
}

TEST(VertexStreams, tangentsAreComputedExactlyForMeshesWithATangentSpaceMapAndNoneOfTheirOwn) {
    scenes::Scene scene = twoMeshes();
    scene.meshes[1].tangentsOS.clear();
    scene.images.emplace_back();
    scene.materials.emplace_back().texture(scenes::TextureSlot::Normal) = {
        .image = 0, .sampler = {}, .texCoordSet = 1, .transform = {}};
    FeatureSet features;
    features.add(Feature::TangentSpaceNormals);
    EXPECT_THAT(makeVertexStreams(scene, features).tangentsOS, Each(glm::vec4(1, 0, 0, 1)))
        << "no instance has the map";
    scene.nodes[0].instances.back().material = 1;
    const VertexStreams streams = makeVertexStreams(scene, features);
    const std::vector<glm::vec4> expected = computeTangents(scene.meshes[1], 1);
    EXPECT_EQ(std::vector(streams.tangentsOS.begin() + 3, streams.tangentsOS.end()), expected);
    scene.meshes[1].tangentsOS.assign(3, {0, 0, 1, 1});
    EXPECT_EQ(makeVertexStreams(scene, features).tangentsOS[4], glm::vec4(0, 0, 1, 1)) << "its own come first";
}

TEST(VertexStreams, tangentsOfAnisotropicAndCoatedMaterialsAlwaysFollowTheirOwnTextureAndFirstTheNormalMaps) {
    scenes::Scene scene = twoMeshes();
    scene.meshes[1].tangentsOS.clear();
    scene.meshes[1].texCoords[1] = {{0, 0}, {0, 1}, {1, 0}};
    scene.images.emplace_back();
    scene.nodes[0].instances.back().material = 1;
    FeatureSet features;
    features.add(Feature::Anisotropy);
    const auto second = [&](const scenes::Material& material) {
        scene.materials.resize(1);
        scene.materials.push_back(material);
        const VertexStreams streams = makeVertexStreams(scene, features);
        return std::vector(streams.tangentsOS.begin() + 3, streams.tangentsOS.end());
    };
    const scenes::TextureUse onSecondSet{.image = 0, .sampler = {}, .texCoordSet = 1, .transform = {}};
    const std::vector<glm::vec4> none(3, glm::vec4(1, 0, 0, 1));
    const std::vector<glm::vec4> ofSet0 = computeTangents(scene.meshes[1], 0);
    const std::vector<glm::vec4> ofSet1 = computeTangents(scene.meshes[1], 1);
    ASSERT_NE(ofSet0, ofSet1);
    scenes::Material material;
    EXPECT_EQ(second(material), none);
    material.anisotropyStrength = 0.5f;
    EXPECT_EQ(second(material), ofSet0) << "without a texture";
    material.texture(scenes::TextureSlot::Anisotropy) = onSecondSet;
    EXPECT_EQ(second(material), ofSet1);
    material.texture(scenes::TextureSlot::Normal).image = 0;
    EXPECT_EQ(second(material), ofSet0) << "the normal map comes first";
    scenes::Material coated;
    coated.clearcoat = 1.0f;
    EXPECT_EQ(second(coated), none) << "a smooth coat needs no tangents";
    coated.texture(scenes::TextureSlot::ClearcoatNormal) = onSecondSet;
    EXPECT_EQ(second(coated), ofSet1);
    scenes::Material brushed;
    brushed.model = scenes::MaterialModel::MicrofacetAnisotropic;
    EXPECT_EQ(second(brushed), ofSet0);
}

} // namespace
} // namespace tessera::frame
