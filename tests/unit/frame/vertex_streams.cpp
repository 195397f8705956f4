#include "renderer/frame/VertexStreams.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "renderer/frame/Tangents.h"
#include "scenes/Load.h"
#include "shaders/shared/facet.h"
#include "tests/support/ErrorText.h"
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

FeatureSet only(std::initializer_list<Feature> features) {
    FeatureSet set;
    for (const Feature feature : features) set.add(feature);
    return set;
}

FeatureSet allButShadows() {
    FeatureSet features = allFeatures();
    features.has.reset(std::size_t(Feature::Shadows));
    return features;
}

void mapNormals(scenes::Scene& scene) {
    scene.images.emplace_back();
    scene.materials[0].texture(scenes::TextureSlot::Normal).image = 0;
}

TEST(VertexStreams, aMeshThatNothingDrawsIsNotThere) {
    scenes::Scene scene = twoMeshes();
    scene.nodes[0].instances.erase(scene.nodes[0].instances.begin());
    const VertexStreams streams = makeVertexStreams(scene, allFeatures());
    ASSERT_EQ(streams.ranges.size(), 1u);
    EXPECT_EQ(streams.ranges.at({1, 0}).firstIndex, 0u);
    EXPECT_EQ(streams.ranges.at({1, 0}).baseVertex, 0);
    EXPECT_EQ(streams.positionsOS.size(), 3u);
}

TEST(VertexStreams, missingAttributesGetTheirNeutralValue) {
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

TEST(VertexStreams, streamsThatNothingNeedsAreEmpty) {
    const VertexStreams streams = makeVertexStreams(twoMeshes(), FeatureSet{});
    EXPECT_EQ(streams.positionsOS.size(), 6u);
    EXPECT_EQ(streams.normalsOS.size(), 6u);
    EXPECT_TRUE(streams.tangentsOS.empty() && streams.texCoords[0].empty() && streams.texCoords[1].empty() &&
                streams.colors.empty());
    const FeatureSet textured = only({featureOf(scenes::TextureSlot::BaseColor)});
    EXPECT_EQ(makeVertexStreams(twoMeshes(), textured).texCoords[0].size(), 6u);
    EXPECT_TRUE(makeVertexStreams(twoMeshes(), textured).texCoords[1].empty());
}

TEST(VertexStreams, aPlanNamesThoseThatAreMade) {
    for (const Feature feature : {Feature::Hook, Feature::SubsurfaceDiffusion, Feature::TexCoord1, Feature::VertexColor,
                                  featureOf(scenes::TextureSlot::BaseColor)}) {
        const VertexStreams made = makeVertexStreams(twoMeshes(), only({feature}));
        const std::vector<std::string> names = streamNames(only({feature}));
        EXPECT_EQ(std::ranges::count(names, "texture_coordinates_0") == 1, !made.texCoords[0].empty());
        EXPECT_EQ(std::ranges::count(names, "texture_coordinates_1") == 1, !made.texCoords[1].empty());
        EXPECT_EQ(std::ranges::count(names, "vertex_colors") == 1, !made.colors.empty());
    }
}

TEST(VertexStreams, tangentsAreComputedExactlyForMeshesWithATangentSpaceMapAndNoneOfTheirOwn) {
    scenes::Scene scene = twoMeshes();
    scene.meshes[1].tangentsOS.clear();
    scene.images.emplace_back();
    scene.materials.emplace_back().texture(scenes::TextureSlot::Normal) = {
        .image = 0, .sampler = {}, .texCoordSet = 1, .transform = {}};
    const FeatureSet features = only({Feature::TangentSpaceNormals});
    EXPECT_THAT(makeVertexStreams(scene, features).tangentsOS, Each(glm::vec4(1, 0, 0, 1)))
        << "no instance has the map";
    scene.nodes[0].instances.back().material = 1;
    const VertexStreams streams = makeVertexStreams(scene, features);
    const std::vector<glm::vec4> expected = meshWithTangents(scene.meshes[1], {{}, 1}).tangentsOS;
    EXPECT_EQ(std::vector(streams.tangentsOS.begin() + 3, streams.tangentsOS.end()), expected);
    scene.meshes[1].tangentsOS.assign(3, {0, 0, 1, 1});
    EXPECT_EQ(makeVertexStreams(scene, features).tangentsOS[4], glm::vec4(0, 0, 1, 1)) << "its own come first";
}

TEST(VertexStreams, tangentsOfAnisotropicAndCoatedMaterialsFollowTheirOwnTextureAndFirstTheNormalMaps) {
    scenes::Scene scene = twoMeshes();
    scene.meshes[1].tangentsOS.clear();
    scene.meshes[1].texCoords[1] = {{0, 0}, {0, 1}, {1, 0}};
    scene.images.emplace_back();
    scene.nodes[0].instances.back().material = 1;
    const FeatureSet features = only({Feature::Anisotropy});
    const auto second = [&](const scenes::Material& material) {
        scene.materials.resize(1);
        scene.materials.push_back(material);
        const VertexStreams streams = makeVertexStreams(scene, features);
        return std::vector(streams.tangentsOS.begin() + 3, streams.tangentsOS.end());
    };
    const scenes::TextureUse onSecondSet{.image = 0, .sampler = {}, .texCoordSet = 1, .transform = {}};
    const std::vector<glm::vec4> none(3, glm::vec4(1, 0, 0, 1));
    const std::vector<glm::vec4> ofSet0 = meshWithTangents(scene.meshes[1], {}).tangentsOS;
    const std::vector<glm::vec4> ofSet1 = meshWithTangents(scene.meshes[1], {{}, 1}).tangentsOS;
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

TEST(VertexStreams, materialsThatWantDifferentTangentsGetAMeshOfTheirOwnAndOthersShare) {
    scenes::Scene scene = twoMeshes();
    scene.meshes[1].tangentsOS.clear();
    scene.images.emplace_back();
    scenes::Material mapped;
    mapped.texture(scenes::TextureSlot::Normal).image = 0;
    for (int i = 0; i < 4; ++i) scene.materials.push_back(mapped);
    scene.materials[3].texture(scenes::TextureSlot::Normal).transform.scale = {1, -1};
    scene.materials[4].tangents = scenes::TangentMethod::Lengyel;
    for (const int material : {1, 2, 3, 3, 4, 2}) scene.nodes[0].instances.push_back({1, material});
    const FeatureSet features = only({Feature::TangentSpaceNormals});
    const VertexStreams streams = makeVertexStreams(scene, features);
    const auto firstIndex = [&](int material) { return streams.ranges.at({1, material}).firstIndex; };
    const std::uint32_t expected[] = {3, 3, 3, 6, 9}; // the first needs no tangents
    for (int material = 0; material < 5; ++material) EXPECT_EQ(firstIndex(material), expected[material]) << material;
    EXPECT_EQ(streams.indices.size(), 12u);
    const auto handedness = [&](int material) {
        return streams.tangentsOS[std::size_t(streams.ranges.at({1, material}).baseVertex)].w;
    };
    EXPECT_EQ(handedness(3), -handedness(1));
    EXPECT_EQ(makeVertexStreams(scene, FeatureSet{}).tangentsOS.size(), 0u);
}

TEST(VertexStreams, splitVerticesKeepAllTheirOtherAttributes) {
    scenes::Scene scene = scenes::tinyScene();
    scenes::Mesh& mesh = scene.meshes[0];
    // A second triangle below the first, with a mirrored texture.
    mesh.positionsOS.emplace_back(0.0f, -4.0f, 0.0f);
    mesh.normalsOS.emplace_back(0, 0, 1);
    mesh.indices.insert(mesh.indices.end(), {1, 0, 3});
    mesh.texCoords[0] = {{0, 1}, {1, 1}, {0, 0}, {0, 0}};
    mesh.texCoords[1] = {{0.1f, 0}, {0.2f, 0}, {0.3f, 0}, {0.4f, 0}};
    mesh.colors = {glm::vec4(0.1f), glm::vec4(0.2f), glm::vec4(0.3f), glm::vec4(0.4f)};
    mapNormals(scene);
    const VertexStreams streams = makeVertexStreams(scene, allFeatures());
    ASSERT_EQ(streams.positionsOS.size(), 6u) << "a copy of both vertices that the triangles share";
    ASSERT_EQ(streams.indices.size(), mesh.indices.size());
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t own = mesh.indices[corner], at = streams.indices[corner];
        EXPECT_EQ(streams.positionsOS.at(at), mesh.positionsOS[own]);
        EXPECT_EQ(streams.normalsOS.at(at), mesh.normalsOS[own]);
        EXPECT_EQ(streams.texCoords[0].at(at), mesh.texCoords[0][own]);
        EXPECT_EQ(streams.texCoords[1].at(at), mesh.texCoords[1][own]);
        EXPECT_EQ(streams.colors.at(at), mesh.colors[own]);
        EXPECT_EQ(streams.tangentsOS.at(at).w, streams.tangentsOS[streams.indices[corner < 3 ? 0 : 3]].w);
    }
    EXPECT_EQ(streams.tangentsOS[streams.indices[0]].w, -streams.tangentsOS[streams.indices[3]].w);
}

/// A triangle in a mesh of many vertices, drawn with 40 materials that rotate its tangents differently.
scenes::Scene sceneOfManyTransforms(std::size_t vertices) {
    scenes::Scene scene = scenes::tinyScene();
    scenes::Mesh& mesh = scene.meshes[0];
    mesh.positionsOS.resize(vertices);
    mesh.normalsOS.resize(vertices, glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.texCoords[0].resize(vertices);
    mapNormals(scene);
    const scenes::Node node = scene.nodes[0];
    for (int i = 1; i < 40; ++i) {
        scene.materials.push_back(scene.materials[0]);
        scene.materials.back().texture(scenes::TextureSlot::Normal).transform.rotationRadians = 0.1f * float(i);
        scene.nodes.push_back(node);
        scene.nodes.back().instances[0].material = i;
    }
    return scene;
}

TEST(VertexStreams, copiesForManyTransformsOfOneLargeMeshAreRefusedBeforeTheyAreMade) {
    const scenes::Scene scene = sceneOfManyTransforms(std::size_t(1) << 20);
    EXPECT_THAT(test::errorText<InputError>([&] { makeVertexStreams(scene, allFeatures()); }),
                testing::HasSubstr("('triangle' has 40 such materials)"));
}

TEST(VertexStreams, aMeshThatBringsTangentsIsNotTakenToBeSplit) {
    scenes::Scene scene = sceneOfManyTransforms(1000);
    scenes::Mesh& mesh = scene.meshes[0];
    mesh.indices.resize(3 << 20); // 13 copies of the corners are too many, of the vertices not
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) mesh.indices[corner] = corner % 3;
    mesh.tangentsOS.resize(mesh.positionsOS.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    scene.nodes.resize(14);
    scene.materials.resize(14);
    // Copies for shadows would count, see the next test.
    EXPECT_EQ(makeVertexStreams(scene, allButShadows()).positionsOS.size(), 14000u);
}

TEST(VertexStreams, copiesOfLastVerticesCountWithThoseForManyTransforms) {
    scenes::Scene scene = sceneOfManyTransforms(1000);
    scenes::Mesh& mesh = scene.meshes[0];
    mesh.indices.assign(3 << 20, 0); // a copied vertex per triangle, 39 times, is too many
    mesh.tangentsOS.resize(mesh.positionsOS.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    EXPECT_THROW(makeVertexStreams(scene, allFeatures()), InputError);
}

TEST(VertexStreams, aVertexOfManyTrianglesWithTangentsOfTheirOwnIsSplitInLittleTime) {
    // A fan of 100,000 triangles that share a vertex and no edge, each rotated differently: comparing each copy with
    // all others would take 5e9 steps.
    constexpr int kTriangles = 100000;
    scenes::Scene scene = scenes::tinyScene();
    scenes::Mesh& mesh = scene.meshes[0];
    mesh.positionsOS = {glm::vec3(0.0f)};
    mesh.indices.clear();
    mesh.texCoords[0] = {glm::vec2(0.0f)};
    for (int i = 0; i < kTriangles; ++i) {
        const double angle = 6.28 * i / kTriangles;
        for (const double corner : {angle, angle + 1e-5}) {
            mesh.positionsOS.emplace_back(std::cos(corner), std::sin(corner), 0.0f);
            mesh.texCoords[0].emplace_back(corner == angle ? 1.0f : 0.0f, corner == angle ? 0.0f : 1.0f);
        }
        const auto first = std::uint32_t(1 + 2 * i);
        mesh.indices.insert(mesh.indices.end(), {0, first, first + 1});
    }
    mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    mapNormals(scene);
    const auto start = std::chrono::steady_clock::now();
    const VertexStreams streams = makeVertexStreams(scene, allFeatures());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_GT(streams.positionsOS.size(), mesh.positionsOS.size() + kTriangles / 2);
}

/// The triangle normals, in the order of the triangles.
std::vector<glm::vec3> facetNormals(const VertexStreams& streams, const VertexStreams::Range& range) {
    std::vector<glm::vec3> normals;
    for (std::uint32_t i = range.firstIndex + 2; i < range.firstIndex + range.indexCount; i += 3)
        normals.push_back(streams.facetNormalsOS[std::size_t(range.baseVertex) + streams.indices[i]]);
    return normals;
}

TEST(VertexStreams, theLastVertexOfEachTriangleHasTheNormalOfItsFront) {
    scenes::Scene scene = twoMeshes();
    // The first triangle has no area and no normal of its own. The fourth ends at the same vertex as the first and
    // shares it. The fifth ends like the second but faces the other way, so its vertex is copied.
    scene.meshes[0].indices = {0, 1, 1, 0, 1, 2, 2, 1, 0, 2, 0, 1, 1, 0, 2};
    const VertexStreams streams = makeVertexStreams(scene, allFeatures());
    const VertexStreams::Range& range = streams.ranges.begin()->second;
    const glm::vec3 front(0, 0, 1);
    EXPECT_THAT(facetNormals(streams, range), ElementsAre(front, front, -front, front, -front));
    EXPECT_EQ(streams.positionsOS.size(), 3u + 1u + 3u);
    EXPECT_EQ(streams.facetNormalsOS.size(), streams.positionsOS.size());
}

/// A wavy grid with shared vertices. Every other two columns mirror their texture, so tangents split the vertices
/// between them; there and elsewhere two triangles of different planes end at the same vertex.
scenes::Scene wavyScene() {
    constexpr std::uint32_t kSide = 9;
    scenes::Scene scene = scenes::tinyScene();
    scenes::Mesh& mesh = scene.meshes[0];
    mesh = {};
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const float number = float(mesh.positionsOS.size());
            mesh.positionsOS.emplace_back(float(x), float(y),
                                          0.3f * std::sin(1.3f * float(x)) * std::cos(0.7f * float(y)));
            mesh.normalsOS.push_back(glm::normalize(glm::vec3(0.002f * number, 0.0f, 1.0f)));
            mesh.texCoords[0].emplace_back(float(x % 4 < 3 ? x % 4 : 1), float(y));
            mesh.texCoords[1].emplace_back(number, -number);
            mesh.colors.emplace_back(number, 0.0f, 1.0f, 1.0f);
            if (x + 1 == kSide || y + 1 == kSide) continue;
            const std::uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
            if (x % 4 < 2)
                mesh.indices.insert(mesh.indices.end(), {a, b, d, c, a, d});
            else
                mesh.indices.insert(mesh.indices.end(), {b, d, a, d, c, a});
        }
    mapNormals(scene);
    return scene;
}

TEST(VertexStreams, copiesOfLastVerticesKeepAllTheirOtherAttributes) {
    const scenes::Scene scene = wavyScene();
    const VertexStreams bare = makeVertexStreams(scene, allButShadows()),
                        full = makeVertexStreams(scene, allFeatures());
    EXPECT_GT(bare.positionsOS.size(), scene.meshes[0].positionsOS.size()) << "tangents split nothing";
    EXPECT_GT(full.positionsOS.size(), bare.positionsOS.size()) << "no triangle's end was copied";
    ASSERT_EQ(full.indices.size(), bare.indices.size());
    const auto expectSame = [&](const auto& copied, const auto& wanted, const char* what) {
        ASSERT_EQ(copied.size(), full.positionsOS.size()) << what;
        for (std::size_t corner = 0; corner < full.indices.size(); ++corner)
            ASSERT_EQ(copied[full.indices[corner]], wanted[bare.indices[corner]]) << what << " of corner " << corner;
    };
    expectSame(full.positionsOS, bare.positionsOS, "position");
    expectSame(full.normalsOS, bare.normalsOS, "normal");
    expectSame(full.tangentsOS, bare.tangentsOS, "tangent");
    expectSame(full.texCoords[0], bare.texCoords[0], "first coordinates");
    expectSame(full.texCoords[1], bare.texCoords[1], "second coordinates");
    expectSame(full.colors, bare.colors, "colour");
    scenes::Scene unmapped = scene;
    unmapped.materials[0].texture(scenes::TextureSlot::Normal).image = scenes::kNone;
    const VertexStreams neutral = makeVertexStreams(unmapped, allFeatures());
    EXPECT_GT(neutral.positionsOS.size(), scene.meshes[0].positionsOS.size());
    EXPECT_EQ(neutral.tangentsOS, std::vector(neutral.positionsOS.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f)));
    ASSERT_EQ(full.facetNormalsOS.size(), full.positionsOS.size());
    for (std::size_t corner = 0; corner < full.indices.size(); corner += 3) {
        glm::dvec3 area(0.0); // by Newell: the sum over the edges
        for (std::size_t i = 0; i < 3; ++i)
            area += glm::cross(glm::dvec3(full.positionsOS[full.indices[corner + i]]),
                               glm::dvec3(full.positionsOS[full.indices[corner + (i + 1) % 3]]));
        // The corner normals differ and are close to the triangle's, so the stored normal is twice as long.
        const glm::dvec3 stored = 0.5 * glm::dvec3(full.facetNormalsOS[full.indices[corner + 2]]);
        // Three roundings of fp32.
        EXPECT_LT(glm::distance(stored, glm::normalize(area)), 3.0 * 0x1p-24) << "triangle " << corner / 3;
    }
}

TEST(VertexStreams, trianglesAreLiftedWhereTheNormalsOfTheirCornersDifferAndAreCloseToTheirOwn) {
    const auto lengthWith = [](double degrees) {
        scenes::Scene scene = scenes::tinyScene();
        scenes::Mesh& mesh = scene.meshes[0];
        const glm::vec3 across = mesh.positionsOS[1] - mesh.positionsOS[0];
        const glm::dvec3 front =
            glm::normalize(glm::dvec3(glm::cross(across, mesh.positionsOS[2] - mesh.positionsOS[0])));
        const double lean = glm::radians(degrees);
        mesh.indices = {0, 1, 2};
        mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(front));
        mesh.normalsOS[1] =
            glm::vec3(2.0 * (std::cos(lean) * front + std::sin(lean) * glm::normalize(glm::dvec3(across))));
        const VertexStreams streams = makeVertexStreams(scene, allFeatures());
        return glm::length(facetNormals(streams, streams.ranges.begin()->second).front());
    };
    constexpr float kRounding = 1e-6f;
    EXPECT_NEAR(lengthWith(1.0), LIFTED_FACET, kRounding);
    EXPECT_NEAR(lengthWith(43.9), LIFTED_FACET, kRounding);
    EXPECT_NEAR(lengthWith(44.1), 1.0f, kRounding);
    EXPECT_NEAR(lengthWith(170.0), 1.0f, kRounding);
}

TEST(VertexStreams, cornersOfTrianglesKeepTheirOrderAndPlacesWhereTheLastOnesAreCopied) {
    const scenes::Scene scene = scenes::loadScene("hall");
    FeatureSet few;
    const VertexStreams bare = makeVertexStreams(scene, few), full = makeVertexStreams(scene, allFeatures());
    EXPECT_TRUE(bare.facetNormalsOS.empty());
    std::size_t vertices = 0;
    for (const scenes::Mesh& mesh : scene.meshes) vertices += mesh.positionsOS.size();
    EXPECT_LE(bare.positionsOS.size(), vertices);
    for (const auto& [key, range] : bare.ranges) {
        const VertexStreams::Range& other = full.ranges.at(key);
        const scenes::Mesh& mesh = scene.meshes[std::size_t(key.first)];
        ASSERT_EQ(other.indexCount, range.indexCount);
        for (std::uint32_t i = 0; i < range.indexCount; ++i) {
            const glm::vec3 place =
                bare.positionsOS[std::size_t(range.baseVertex) + bare.indices[range.firstIndex + i]];
            ASSERT_EQ(full.positionsOS[std::size_t(other.baseVertex) + full.indices[other.firstIndex + i]], place);
            ASSERT_EQ(place, mesh.positionsOS[mesh.indices[i]]) << scene.meshes[std::size_t(key.first)].name;
        }
    }
}

} // namespace
} // namespace tessera::frame
