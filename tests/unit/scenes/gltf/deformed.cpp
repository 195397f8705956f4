// Skins and morph targets of glTF files.

#include "tests/unit/scenes/gltf/AnimationBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

/// The triangle with a skin of joints 1 and 2; 2 is a child of 1, moved 1 along x. Every vertex follows joint 2.
Builder skinnedTriangle() {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0, "translation": [7, 7, 7]}, {"children": [2]},
                                {"translation": [1, 0, 0]}],
                      "scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2]}]})");
    builder.attribute<std::uint8_t>("JOINTS_0", "VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    builder.attribute("WEIGHTS_0", "VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    return builder;
}

// ---- Skins ---------------------------------------------------------------------------------------------------------

TEST(GltfSkins, verticesFollowTheirJointsAndNotTheirNode) {
    Builder builder = skinnedTriangle();
    animate(builder, 2, "rotation", "VEC4", {0, 0, 0, 1, 0, 0, kHalfRoot, kHalfRoot});
    const Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    expectPlace(drawnAt(scene, 0.0)[1], {2.0, 0.0, 0.0});
    expectPlace(drawnAt(scene, 1.0)[1], {1.0, 1.0, 0.0});
}

TEST(GltfSkins, inverseBindMatricesComeFirst) {
    Builder builder = skinnedTriangle();
    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u}) matrices[i] = 1.0f;
    matrices[16 + 12] = -1.0f;
    builder.json["skins"][0]["inverseBindMatrices"] = builder.add("MAT4", matrices);
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 0.0});
    builder.json["accessors"].back()["count"] = 1;
    EXPECT_THAT(builder.error(), HasSubstr("/skins/0/inverseBindMatrices: accessor 3 has 1 matrices for 2 joints"));
    builder.json["accessors"].back()["type"] = "VEC4";
    EXPECT_THAT(builder.error(), HasSubstr("accessor 3 must be of MAT4"));
}

/// The fourth row is 0 0 0 1 by the specification; other values in a file have no effect.
TEST(GltfSkins, theLastRowOfAnInverseBindMatrixIsNotRead) {
    Builder builder = skinnedTriangle();
    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i : {0u, 5u, 10u, 16u, 21u, 26u}) matrices[i] = 1.0f;
    for (std::size_t i : {3u, 7u, 11u, 15u, 19u, 23u, 27u, 31u}) matrices[i] = 0.25f;
    matrices[16 + 12] = -1.0f;
    builder.json["skins"][0]["inverseBindMatrices"] = builder.add("MAT4", matrices);
    const Scene scene = builder.import();
    expectPlace(drawnAt(scene, 0.0)[1], {1.0, 0.0, 0.0});
    for (const glm::dmat4& matrix : scene.rig.skins[0].jointFromBind)
        EXPECT_EQ(glm::transpose(matrix)[3], glm::dvec4(0.0, 0.0, 0.0, 1.0));
}

TEST(GltfSkins, aVertexMayFollowEightJoints) {
    Builder builder = skinnedTriangle();
    builder.attribute("JOINTS_1", "VEC4", std::vector<std::uint16_t>(12, 0));
    builder.attribute("WEIGHTS_1", "VEC4", std::vector<std::uint8_t>(12, 85), true); // four thirds in all
    // Weights 1 of joint 2 and 4/3 of joint 1.
    expectPlace(drawnAt(builder.import(), 0.0)[0], {1.0 / (1.0 + 4.0 / 3.0), 0.0, 0.0});
}

/// A chain of joints, 1 mm each; the middle one rotates.
TEST(GltfSkins, tenThousandJointsAreFollowed) {
    constexpr int kJoints = 10'000, kMiddle = 5'000;
    Builder builder = skinnedTriangle();
    Json joints = Json::array(), nodes = Json::array({Json::object({{"mesh", 0}, {"skin", 0}})});
    for (int joint = 1; joint <= kJoints; ++joint) {
        Json& node = nodes.emplace_back(Json::object({{"translation", {0.001, 0, 0}}}));
        if (joint < kJoints) node["children"] = Json::array({joint + 1});
        joints.push_back(joint);
    }
    builder.json["nodes"] = nodes;
    builder.json["skins"][0]["joints"] = joints;
    std::vector<std::uint16_t> followed(12, 0);
    for (std::size_t vertex = 0; vertex < 3; ++vertex) followed[4 * vertex] = kJoints - 1;
    builder.attribute("JOINTS_0", "VEC4", followed);
    animate(builder, kMiddle, "rotation", "VEC4", {0, 0, 0, 1, 0, 0, 1, 0});
    const Scene scene = builder.import();
    expectPlace(drawnAt(scene, 0.0)[1], {11.0, 0.0, 0.0});
    expectPlace(drawnAt(scene, 1.0)[1], {-1.0, 0.0, 0.0}); // half a turn about (5, 0)
    expectPlace(drawnAt(scene, 0.5)[1], {5.0, 6.0, 0.0});
}

TEST(GltfSkins, jointsOutsideOfTheSceneAreFollowedAndNotDrawn) {
    Builder builder = skinnedTriangle();
    builder.json["nodes"][1]["mesh"] = 0;
    builder.json["nodes"][1]["translation"] = {0, 5, 0};
    builder.json["scenes"][0]["nodes"] = Json::array({0});
    const Scene scene = builder.import();
    EXPECT_EQ(triangleCount(scene), 1u);
    expectPlace(drawnAt(scene, 0.0)[0], {1.0, 5.0, 0.0});
}

TEST(GltfSkins, jointsThatTheSkinLacksAreRefusedUnlessTheirWeightIsZero) {
    Builder builder = skinnedTriangle();
    builder.json["skins"][0]["joints"] = Json::array({1});
    EXPECT_THAT(builder.error(), HasSubstr("/meshes/0: vertex 0 of mesh 'mesh 0' follows joint 1, but /skins/0 has "
                                           "only 1"));
    Builder spare = skinnedTriangle();
    spare.attribute<std::uint8_t>("JOINTS_0", "VEC4", {1, 200, 0, 0, 1, 200, 0, 0, 1, 200, 0, 0});
    expectPlace(drawnAt(spare.import(), 0.0)[0], {1.0, 0.0, 0.0});
}

TEST(GltfSkins, instancesOfOneMeshAreDeformedEachByItsOwnSkin) {
    Builder builder = skinnedTriangle();
    builder.json["skins"].push_back(Json::object({{"joints", Json::array({1, 1})}}));
    builder.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
    builder.json["nodes"].push_back(Json::object({{"mesh", 0}}));
    builder.json["scenes"][0]["nodes"] = Json::array({0, 1, 3, 4});
    const std::vector<glm::dvec3> places = drawnAt(builder.import(), 0.0);
    ASSERT_EQ(places.size(), 9u);
    expectPlace(places[0], {0.0, 0.0, 0.0}); // node 4, unskinned; skinned nodes come after all others
    expectPlace(places[3], {1.0, 0.0, 0.0});
    expectPlace(places[6], {0.0, 0.0, 0.0});
}

// ---- Morph targets -------------------------------------------------------------------------------------------------

TEST(GltfMorphTargets, weightsOfTheNodeGoBeforeThoseOfTheMesh) {
    Builder builder;
    builder.target({0, 0, 1, 0, 0, 1, 0, 0, 1});
    EXPECT_TRUE(builder.import().rig.deformed.empty()) << "nothing can move it";
    builder.json["meshes"][0]["weights"] = Json::array({0.5});
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 0.5});
    builder.json["nodes"][0]["weights"] = Json::array({2});
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 2.0});
}

TEST(GltfMorphTargets, everyAttributeIsMorphedAndWeightsAreAnimated) {
    Builder builder;
    builder.attribute("NORMAL", "VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    builder.attribute("TANGENT", "VEC4", {1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1});
    builder.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, 0, 0, 1});
    builder.attribute("COLOR_0", "VEC4", std::vector<float>(12, 0.5f));
    const int ones = builder.add("VEC3", std::vector<float>(9, 1.0f));
    builder.primitive()["targets"] = Json::array({Json::object({{"POSITION", ones}}),
                                                  {{"NORMAL", builder.add("VEC3", {1, 0, 0, 0, 0, 0, 0, 0, 0})},
                                                   {"TANGENT", builder.add("VEC3", {-1, 1, 0, 0, 0, 0, 0, 0, 0})},
                                                   {"TEXCOORD_0", builder.add("VEC2", std::vector<float>(6, 0.25f))},
                                                   {"COLOR_0", builder.add("VEC3", {1, 0, 0, 0, 0, 0, -1, 0, 0})}}});
    animate(builder, 0, "weights", "SCALAR", {0, 0, 0.5f, 1});
    Scene scene = builder.import();
    poseScene(scene, 1.0);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positionsOS[1], glm::vec3(1.5f, 0.5f, 0.5f));
    EXPECT_NEAR(mesh.normalsOS[0].x, kHalfRoot, 1e-6f);
    EXPECT_NEAR(mesh.tangentsOS[0].y, 1.0f, 1e-6f);
    EXPECT_EQ(mesh.tangentsOS[0].w, -1.0f);
    EXPECT_EQ(mesh.texCoords[0][0], glm::vec2(0.25f));
    EXPECT_EQ(mesh.colors[0], glm::vec4(1.0f, 0.5f, 0.5f, 0.5f));
    EXPECT_EQ(mesh.colors[2].x, 0.0f);
}

TEST(GltfMorphTargets, sparseTargetsWithoutAViewAddToTheirVerticesAlone) {
    Builder builder;
    builder.json["accessors"].push_back({{"componentType", kFloatType}, {"type", "VEC3"}, {"count", 3}});
    builder.makeSparse<std::uint16_t>(1, {2}, {0, 0, 3});
    builder.primitive()["targets"] = Json::array({Json::object({{"POSITION", 1}})});
    builder.json["nodes"][0]["weights"] = Json::array({1});
    const std::vector<glm::dvec3> places = drawnAt(builder.import(), 0.0);
    expectPlace(places[0], {0.0, 0.0, 0.0});
    expectPlace(places[2], {0.0, 1.0, 3.0});
}

TEST(GltfMorphTargets, flatNormalsFollowTheDeformedTriangle) {
    Builder builder;
    builder.indices({2, 0, 1});
    builder.target({0, 0, 0, 0, 0, 1, 0, 0, 0});
    builder.json["nodes"][0]["weights"] = Json::array({1});
    Scene scene = builder.import();
    poseScene(scene, 0.0);
    // (0,0,0) (1,0,1) (0,1,0): the plane x = z.
    for (const glm::vec3& normalOS : scene.meshes.at(0).normalsOS) {
        EXPECT_NEAR(normalOS.x, -kHalfRoot, 1e-6f);
        EXPECT_NEAR(normalOS.z, kHalfRoot, 1e-6f);
    }
}

TEST(GltfMorphTargets, anotherLengthIsRefusedByName) {
    Builder builder;
    builder.target(std::vector<float>(6, 0.0f));
    builder.json["nodes"][0]["weights"] = Json::array({1});
    EXPECT_THAT(builder.error(), HasSubstr("/meshes/0/primitives/0/targets/0/POSITION: accessor 1 of mesh 'mesh 0' "
                                           "has 2 elements, but there are 3 positions"));
}

// ---- Limits --------------------------------------------------------------------------------------------------------

TEST(GltfSkins, deformedInstancesAreChargedBeforeTheyAreCopied) {
    const auto errorWith = [](int instances) {
        constexpr std::size_t kVertices = 3000;
        Builder builder = skinnedTriangle();
        builder.attribute("POSITION", "VEC3", std::vector<float>(3 * kVertices));
        builder.attribute("JOINTS_0", "VEC4", std::vector<std::uint8_t>(4 * kVertices));
        builder.attribute("WEIGHTS_0", "VEC4", std::vector<float>(4 * kVertices));
        Json roots = Json::array({0, 1});
        for (int i = 0; i < instances; ++i) {
            roots.push_back(builder.json["nodes"].size());
            builder.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
        }
        builder.json["scenes"][0]["nodes"] = roots;
        return builder.error(64 * kMiB);
    };
    EXPECT_EQ(errorWith(20), "");
    // 84 KB each
    EXPECT_THAT(errorWith(2000), HasSubstr("/nodes/"));
}

TEST(GltfMorphTargets, weightsOfNodesAreChargedByTargetsAndNodes) {
    const auto errorWith = [](int targets, int nodes) {
        Builder builder;
        const int moved = builder.add("VEC3", std::vector<float>(9, 1.0f));
        builder.primitive()["targets"] = Json::array();
        for (int i = 0; i < targets; ++i) builder.primitive()["targets"].push_back(Json::object({{"POSITION", moved}}));
        builder.json["meshes"][0]["weights"] = Json::array({1});
        builder.json["nodes"] = Json::array();
        builder.json["scenes"][0]["nodes"] = Json::array();
        for (int i = 0; i < nodes; ++i) {
            builder.json["nodes"].push_back(Json::object({{"mesh", 0}}));
            builder.json["scenes"][0]["nodes"].push_back(i);
        }
        return builder.error(64 * kMiB);
    };
    EXPECT_EQ(errorWith(3000, 30), "");
    EXPECT_EQ(errorWith(30, 3000), "");
    // 108 MB more than either alone: 36 KB per node
    EXPECT_THAT(errorWith(3000, 3000), HasSubstr("/nodes/"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
