#include <cmath>

#include "NodeBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

TEST(GltfNodes, transformIsTranslationTimesRotationTimesScale) {
    // A quarter turn about Y sends +X to -Z.
    const Scene scene =
        withNodes(R"([{"mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
                       "scale": [2, 3, 4]}])")
            .import();
    const glm::dmat4& parentFromNode = scene.nodes.at(0).parentFromNode;
    expectNear(glm::dvec3(parentFromNode * glm::dvec4(1, 0, 0, 1)), {1, 2, 1});
    expectNear(glm::dvec3(parentFromNode * glm::dvec4(0, 1, 0, 1)), {1, 5, 3});
    expectNear(glm::dvec3(parentFromNode * glm::dvec4(0, 0, 1, 1)), {5, 2, 3});
}

TEST(GltfNodes, matrixIsReadExactlyColumnByColumnInDouble) {
    const Scene scene = withNodes(R"([{"matrix": [1,2,3,0, 4,5,6,0, 7,8,9,0, 1000000.123456789,11,12,1]}])").import();
    const glm::dmat4& matrix = scene.nodes.at(0).parentFromNode;
    EXPECT_EQ(matrix[0], glm::dvec4(1, 2, 3, 0));
    EXPECT_EQ(matrix[3], glm::dvec4(1000000.123456789, 11, 12, 1));
}

TEST(GltfNodes, matrixIsUsedInsteadOfTheOtherTransforms) {
    const Scene scene =
        withNodes(R"([{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1], "translation": [9, 9, 9], "scale": [2, 2, 2]}])")
            .import();
    EXPECT_EQ(scene.nodes.at(0).parentFromNode, glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {5, 6, 7, 1}));
}

TEST(GltfNodes, orderIsDepthFirst) {
    const Scene scene = withNodes(R"([{"name": "d"}, {"name": "a", "children": [3, 2]}, {"name": "c"},
                                      {"name": "b", "children": [4]}, {}])",
                                  "[1, 0]")
                            .import();
    ASSERT_EQ(scene.nodes.size(), 5u);
    const std::vector<std::string> names = {"a", "b", "node 4", "c", "d"};
    const std::vector<int> parents = {kNone, 0, 1, 0, kNone};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(scene.nodes[i].name, names[i]);
        EXPECT_EQ(scene.nodes[i].parent, parents[i]);
    }
}

TEST(GltfNodes, sceneIsTheDefaultElseTheFirstElseEveryRoot) {
    Builder builder = withNodes(R"([{"name": "a"}, {"name": "b", "children": [2]}, {"name": "c"}])");
    builder.json["scenes"] = Json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
    builder.json["scene"] = 1;
    EXPECT_EQ(builder.import().nodes.at(0).name, "b");
    builder.json.erase("scene");
    EXPECT_EQ(builder.import().nodes.at(0).name, "a");
    builder.json.erase("scenes");
    EXPECT_EQ(builder.import().nodes.size(), 3u);
}

TEST(GltfNodes, meshAtTwoNodesIsShared) {
    const Scene scene = withNodes(R"([{"mesh": 0}, {"mesh": 0}])", "[0, 1]").import();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.nodes.at(0).instances.at(0).mesh, scene.nodes.at(1).instances.at(0).mesh);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(GltfNodes, everyPrimitiveIsExactlyOneMesh) {
    Builder builder;
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    const Scene scene = builder.import();
    ASSERT_EQ(scene.nodes.at(0).instances.size(), 2u);
    EXPECT_EQ(scene.meshes.at(1).name, "mesh 0 primitive 1");
}

TEST(GltfNodes, graphThatIsNoForestIsRefused) {
    EXPECT_EQ(withNodes(R"([{"children": [1]}, {}])", "[0]").error(), "");
    for (const Builder& builder :
         {withNodes(R"([{"children": [1, 2]}, {"children": [2]}, {}])"), withNodes(R"([{"children": [0]}])"),
          withNodes(R"([{"children": [1]}, {}])", "[0, 1]"), withNodes("[{}]", "[0, 0]")})
        EXPECT_THAT(builder.error(), HasSubstr("has several parents, or is a root as well"));
}

TEST(GltfNodes, unusableTransformIsRefused) {
    EXPECT_THAT(withNodes(R"([{"rotation": [0, 0, 0, 0]}])").error(),
                HasSubstr("/nodes/0/rotation: is the zero quaternion"));
    EXPECT_THAT(withNodes(R"([{"matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])").error(),
                HasSubstr("/nodes/0/matrix: is not affine"));
}

TEST(GltfNodes, deepHierarchyNeverOverflowsTheStack) {
    Builder builder;
    Json nodes = Json::array();
    constexpr int kDepth = 20000;
    for (int i = 0; i < kDepth; ++i)
        nodes.push_back(i + 1 < kDepth ? Json{{"children", Json::array({i + 1})}} : Json{{"mesh", 0}});
    builder.json["nodes"] = nodes;
    EXPECT_EQ(builder.import().nodes.size(), std::size_t(kDepth));
}

// ---- Cameras -------------------------------------------------------------------------------------------------------

TEST(GltfCameras, perspectiveIsImportedExactly) {
    Builder builder =
        withNodes(R"([{"camera": 0, "translation": [1, 2, 3], "scale": [5, 5, 5]}, {"camera": 1}])", "[0, 1]");
    builder.merge(R"({"cameras": [
        {"name": "front", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25, "zfar": 90}},
        {"type": "perspective", "perspective": {"yfov": 1.5, "znear": 1}}]})");
    const Scene scene = builder.import();
    ASSERT_EQ(scene.cameras.size(), 2u);
    const glm::dmat4 worldFromCamera({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1});
    EXPECT_EQ(scene.cameras[0], (Camera{"front", Projection::Perspective, worldFromCamera, 0.5, 1.0, 0.25, 90.0}));
    EXPECT_EQ(scene.cameras[1].name, "camera 1");
    EXPECT_TRUE(std::isinf(scene.cameras[1].farMetres));
}

TEST(GltfCameras, orthographicIsImportedExactly) {
    Builder builder = withNodes(R"([{"camera": 0}])");
    builder.merge(
        R"({"cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 7}}]})");
    const Camera camera = builder.import().cameras.at(0);
    EXPECT_EQ(camera.projection, Projection::Orthographic);
    EXPECT_EQ(glm::dvec3(camera.halfHeightMetres, camera.nearMetres, camera.farMetres), glm::dvec3(3.0, 0.0, 7.0));
}

/// 1e15 m is the farthest that is not refused (docs/numerics.md).
TEST(GltfCameras, theFarthestLensIsImportedExactly) {
    Builder builder = withNodes(R"([{"camera": 0}, {"camera": 1}])", "[0, 1]");
    builder.merge(R"({"cameras": [
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 1e15}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": -1e15, "znear": 1e15, "zfar": 2e15}}]})");
    const Scene scene = builder.import();
    EXPECT_THAT(scene.warnings, IsEmpty());
    for (const Camera& camera : scene.cameras) EXPECT_EQ(camera.nearMetres, 1e15);
    EXPECT_EQ(scene.cameras.at(1).halfHeightMetres, 1e15);
}

TEST(GltfCameras, worldFromCameraIsRigid) {
    Builder builder = withNodes(R"([{"scale": [-1, 2, 0.5], "rotation": [0.2, 0.4, 0.1, 0.9], "children": [1]},
                                    {"camera": 0, "rotation": [0.5, 0.1, 0.3, 0.7]}])");
    builder.merge(R"({"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]})");
    const glm::dmat3 rotation(builder.import().cameras.at(0).worldFromCamera);
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, kNodeRounding);
    EXPECT_NEAR(glm::determinant(rotation), 1.0, kNodeRounding);
}

TEST(GltfCameras, namesAreUnique) {
    Builder builder = withNodes(R"([{"camera": 0}, {"camera": 0}])", "[0, 1]");
    builder.merge(R"({"cameras": [{"name": "eye", "type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]})");
    EXPECT_EQ(builder.import().cameras.at(1).name, "eye 2");
}

TEST(GltfCameras, impossibleLensIsRefused) {
    const auto errorOf = [](const char* camera) {
        Builder builder = withNodes(R"([{"camera": 0}])");
        builder.json["cameras"] = Json::array({Json::parse(camera)});
        return builder.error();
    };
    EXPECT_THAT(errorOf(R"({"type": "perspective", "perspective": {"yfov": 4, "znear": 1}})"),
                HasSubstr("/cameras/0/perspective/yfov: is 4"));
    EXPECT_THAT(errorOf(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}})"),
                HasSubstr("/perspective: has znear 0 and zfar inf; znear must be more than 0"));
    EXPECT_THAT(errorOf(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}})"),
                HasSubstr("/perspective: has znear 2 and zfar 1; znear must be more than 0 and less"));
    EXPECT_THAT(errorOf(R"({"type": "orthographic"})"),
                HasSubstr("/cameras/0: the required property 'orthographic' is missing"));
    EXPECT_THAT(errorOf(R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 0, "znear": 0, "zfar": 1}})"),
                HasSubstr("/orthographic/ymag: is 0"));
}

// ---- Instances -----------------------------------------------------------------------------------------------------

Json& instancesOf(Builder& builder) {
    return builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

/// Node 0 draws two instances of the triangle, the second turned by a quarter about Y and twice as large; node 1 after
/// it is empty.
Builder withInstances() {
    Builder builder =
        withNodes(R"([{"name": "tree", "mesh": 0, "translation": [0, 5, 0]}, {"name": "last"}])", "[0, 1]");
    const int translations = builder.add("VEC3", {1, 0, 0, 2, 0, 0});
    // Normalised bytes: 90 / 127 is about the sine of an eighth turn, and the quaternion's length does not matter.
    const int rotations = builder.add<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 90, 0, 90}, true);
    const int scales = builder.add("VEC3", {1, 1, 1, 2, 2, 2});
    instancesOf(builder) = {{"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
    builder.json["extensionsRequired"] = builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    return builder;
}

TEST(GltfInstances, eachIsANodeBelowThatOfItsMeshAfterAllOthers) {
    const Scene scene = withInstances().import();
    ASSERT_EQ(scene.nodes.size(), 4u);
    EXPECT_TRUE(scene.nodes[0].instances.empty());
    EXPECT_EQ(scene.nodes[1].name, "last");
    EXPECT_EQ(scene.nodes[2].name, "tree 0");
    EXPECT_EQ(scene.nodes[3].name, "tree 1");
    EXPECT_EQ(scene.nodes[3].parent, 0);
    ASSERT_EQ(scene.nodes[3].instances.size(), 1u);
    EXPECT_EQ(scene.meshes.size(), 1u) << "they share it";
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    expectNear(glm::dvec3(worldFromNode[2] * glm::dvec4(1, 0, 0, 1)), {2, 5, 0});
    expectNear(glm::dvec3(worldFromNode[3] * glm::dvec4(1, 0, 0, 1)), {2, 5, -2});
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfInstances, aThicknessIsScaledAsEachInstance) {
    Builder builder = withInstances();
    builder.material()["extensions"] = Json::parse(
        R"({"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 0.5}})");
    const Scene scene = builder.import();
    EXPECT_FALSE(hasWarning(scene, "the thickness of material 0 is taken in metres"));
    const auto thicknessAt = [&](std::size_t node) {
        return scene.materials.at(std::size_t(scene.nodes.at(node).instances.at(0).material)).thicknessMetres;
    };
    EXPECT_FLOAT_EQ(thicknessAt(2), 0.5f);
    EXPECT_FLOAT_EQ(thicknessAt(3), 1.0f);
    instancesOf(builder)["SCALE"] = builder.add("VEC3", {3, 3, 3, 3, 3, 3});
    EXPECT_FLOAT_EQ(builder.import().materials.at(0).thicknessMetres, 1.5f);
}

TEST(GltfInstances, attributesThatPlaceNothingAreRefusedByName) {
    const auto errorWith = [](const char* attribute, const std::vector<float>& values, const char* type) {
        Builder builder = withInstances();
        const int accessor = builder.add(type, values);
        instancesOf(builder)[attribute] = accessor;
        return builder.error();
    };
    EXPECT_THAT(errorWith("TRANSLATION", {1, 2, 3}, "VEC3"),
                HasSubstr("/TRANSLATION: accessor 4 has 1 elements, but there are 2 instances"));
    EXPECT_THAT(errorWith("SCALE", {1, 2}, "SCALAR"), HasSubstr("/SCALE: accessor 4 has 1 components"));
    EXPECT_THAT(errorWith("ROTATION", {0, 0, 0, 1, 0, 0, 0, 0}, "VEC4"), HasSubstr("element 1 is the zero quaternion"));
    Builder none = withInstances();
    instancesOf(none) = Json::object();
    EXPECT_THAT(none.error(), HasSubstr("holds nothing that says how many instances there are"));
}

TEST(GltfInstances, ofDeformedMeshesAreLeftOutWithAWarning) {
    Builder builder = withInstances();
    builder.primitive()["targets"] = Json::parse(R"([{"POSITION": 0}])");
    builder.json["meshes"][0]["weights"] = {0.5};
    const Scene scene = builder.import();
    EXPECT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].instances.size(), 1u);
    EXPECT_TRUE(hasWarning(scene, "/nodes/0: its mesh is skinned or has morph targets"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
