#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Rounding of a few double operations on numbers near 1.
constexpr double kNodeRounding = 1e-14;

void expectNear(const glm::dvec3& value, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(value - expected), kNodeRounding) << value.x << ' ' << value.y << ' ' << value.z;
}

Builder withNodes(const char* nodes, const char* roots = "[0]") {
    Builder builder;
    builder.json["nodes"] = Json::parse(nodes);
    builder.json["scenes"][0]["nodes"] = Json::parse(roots);
    return builder;
}

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
    EXPECT_NE(withNodes(R"([{"children": [1]}, {"children": [2]}, {"children": [1]}])")
                  .error()
                  .find("is a child of both node"),
              std::string::npos);
    EXPECT_NE(withNodes(R"([{}, {"children": [2]}, {"children": [1]}])").error().find("is its own ancestor"),
              std::string::npos);
    EXPECT_NE(withNodes(R"([{"children": [0]}])").error().find("/nodes/0: is its own ancestor"), std::string::npos);
    EXPECT_NE(withNodes(R"([{"children": [1]}, {}])", "[0, 1]")
                  .error()
                  .find("lists node 1, which is no root but a child of node 0"),
              std::string::npos);
    EXPECT_NE(withNodes(R"([{}])", "[0, 0]").error().find("/scenes/0/nodes: lists node 0 twice"), std::string::npos);
}

TEST(GltfNodes, unusableTransformIsRefused) {
    EXPECT_NE(withNodes(R"([{"rotation": [0, 0, 0, 0]}])").error().find("/nodes/0/rotation: is the zero quaternion"),
              std::string::npos);
    EXPECT_NE(withNodes(R"([{"matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])")
                  .error()
                  .find("/nodes/0/matrix: is not affine"),
              std::string::npos);
}

TEST(GltfNodes, deepHierarchyNeverOverflowsTheStack) {
    Builder builder;
    Json nodes = Json::array();
    constexpr int kDepth = 20000;
    for (int i = 0; i < kDepth; ++i)
        nodes.push_back(i + 1 < kDepth ? Json{{"children", Json::array({i + 1})}} : Json{{"mesh", 0}});
    builder.json["nodes"] = nodes;
    EXPECT_EQ(builder.import().nodes.size(), static_cast<std::size_t>(kDepth));
}

// ---- Cameras -------------------------------------------------------------------------------------------------------

TEST(GltfCameras, perspectiveIsImportedExactly) {
    Builder builder =
        withNodes(R"([{"camera": 0, "translation": [1, 2, 3], "scale": [5, 5, 5]}, {"camera": 1}])", "[0, 1]");
    builder.merge(
        R"({"cameras": [{"name": "front", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25, "zfar": 90}},
                                  {"type": "perspective", "perspective": {"yfov": 1.5, "znear": 1}}]})");
    const Scene scene = builder.import();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_EQ(scene.cameras[0].projection, Projection::Perspective);
    EXPECT_EQ(scene.cameras[0].fovYRadians, 0.5);
    EXPECT_EQ(scene.cameras[0].nearMetres, 0.25);
    EXPECT_EQ(scene.cameras[0].farMetres, 90.0);
    EXPECT_EQ(scene.cameras[0].worldFromCamera, glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 2, 3, 1}));
    EXPECT_EQ(scene.cameras[1].name, "camera 1");
    EXPECT_TRUE(std::isinf(scene.cameras[1].farMetres));
}

TEST(GltfCameras, orthographicIsImportedExactly) {
    Builder builder = withNodes(R"([{"camera": 0}])");
    builder.merge(
        R"({"cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 7}}]})");
    const Camera camera = builder.import().cameras.at(0);
    EXPECT_EQ(camera.projection, Projection::Orthographic);
    EXPECT_EQ(camera.halfHeightMetres, 3.0);
    EXPECT_EQ(camera.nearMetres, 0.0);
    EXPECT_EQ(camera.farMetres, 7.0);
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
    EXPECT_NE(errorOf(R"({"type": "perspective", "perspective": {"yfov": 4, "znear": 1}})")
                  .find("/cameras/0/perspective/yfov: is 4"),
              std::string::npos);
    EXPECT_NE(errorOf(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}})")
                  .find("znear: is 0; it must be greater"),
              std::string::npos);
    EXPECT_NE(errorOf(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}})")
                  .find("zfar: is 1; it must be "),
              std::string::npos);
    EXPECT_NE(
        errorOf(R"({"type": "orthographic"})").find("/cameras/0: the required property 'orthographic' is missing"),
        std::string::npos);
    EXPECT_NE(errorOf(R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 0, "znear": 0, "zfar": 1}})")
                  .find("must not be 0"),
              std::string::npos);
}

// ---- Lights --------------------------------------------------------------------------------------------------------

Builder withLight(const char* light, const char* node = "{}") {
    Builder builder = withNodes("[{}]");
    builder.merge(R"({"extensionsUsed": ["KHR_lights_punctual"]})");
    builder.json["nodes"][0] = Json::parse(node);
    builder.json["nodes"][0]["extensions"] = Json::parse(R"({"KHR_lights_punctual": {"light": 0}})");
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({Json::parse(light)});
    return builder;
}

TEST(GltfLights, pointLightIsImportedExactly) {
    const Scene scene =
        withLight(R"({"type": "point", "name": "lamp", "color": [1, 0.5, 0.25], "intensity": 40, "range": 8})",
                  R"({"translation": [1, 2, 3], "scale": [9, 9, 9]})")
            .import();
    const Light& light = scene.lights.at(0);
    EXPECT_EQ(light.name, "lamp");
    EXPECT_EQ(light.type, LightType::Point);
    EXPECT_EQ(light.falloff, Falloff::InverseSquare);
    EXPECT_EQ(light.color, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(light.intensity, 40.0f);
    EXPECT_EQ(light.rangeMetres, 8.0f);
    EXPECT_EQ(light.positionWS, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(light.enabled);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLights, absentRangeIsInfinite) {
    const Light light = withLight(R"({"type": "point"})").import().lights.at(0);
    EXPECT_EQ(light.rangeMetres, kInfinity);
    EXPECT_EQ(light.intensity, 1.0f);
    EXPECT_EQ(light.name, "light 0");
}

TEST(GltfLights, directionIsMinusZOfTheNode) {
    const char* node = R"({"rotation": [0, 0.7071067811865476, 0, 0.7071067811865476], "scale": [3, 2, 7]})";
    expectNear(withLight(R"({"type": "directional", "intensity": 3})", node).import().lights.at(0).directionWS,
               {-1, 0, 0});
    const char* tilted = R"({"rotation": [0.7071067811865476, 0, 0, 0.7071067811865476]})";
    expectNear(withLight(R"({"type": "directional"})", tilted).import().lights.at(0).directionWS, {0, 1, 0});
}

TEST(GltfLights, hugeAndTinyNestedScalesLeaveTheDirection) {
    for (const char* scale : {"[1e38, 1e38, 1e38]", "[1e-38, 1e-38, 1e-38]"}) {
        Builder builder = withLight(R"({"type": "spot", "spot": {}})");
        Json& nodes = builder.json["nodes"];
        Json lamp = nodes[0];
        lamp["rotation"] = Json::parse("[0, 0.7071067811865476, 0, 0.7071067811865476]");
        nodes = Json::array();
        for (int i = 0; i < 6; ++i) nodes.push_back({{"scale", Json::parse(scale)}, {"children", {i + 1}}});
        nodes.push_back(lamp);
        const Scene scene = builder.import();
        expectNear(scene.lights.at(0).directionWS, {-1, 0, 0});
        EXPECT_TRUE(scene.warnings.empty()) << scale;
    }
}

TEST(GltfLights, spotConesAreImportedExactly) {
    const Light spot =
        withLight(R"({"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}})").import().lights.at(0);
    EXPECT_EQ(spot.type, LightType::Spot);
    EXPECT_EQ(spot.innerConeRadians, 0.25f);
    EXPECT_EQ(spot.outerConeRadians, 0.5f);
    const Light wide = withLight(R"({"type": "spot", "spot": {}})").import().lights.at(0);
    EXPECT_EQ(wide.innerConeRadians, 0.0f);
    EXPECT_FLOAT_EQ(wide.outerConeRadians, static_cast<float>(std::numbers::pi / 4));
}

TEST(GltfLights, impossibleLightIsRefused) {
    EXPECT_NE(
        withLight(R"({"type": "lamp"})").error().find("lights/0/type: is 'lamp'; valid are directional, point, spot"),
        std::string::npos);
    EXPECT_NE(withLight(R"({"type": "point", "range": 0})").error().find("lights/0/range: must be greater than 0"),
              std::string::npos);
    EXPECT_NE(
        withLight(R"({"type": "point", "intensity": -1})").error().find("intensity: is -1; it must be at least 0"),
        std::string::npos);
    EXPECT_NE(withLight(R"({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}})")
                  .error()
                  .find("0 <= inner < outer"),
              std::string::npos);
    EXPECT_NE(withLight(R"({"type": "spot"})").error().find("lights/0: the required property 'spot' is missing"),
              std::string::npos);
    Builder builder = withLight(R"({"type": "point"})");
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_NE(builder.error().find("points at /extensions/KHR_lights_punctual/lights/1, but there are only 1"),
              std::string::npos);
}

TEST(GltfLights, orderIsThatOfTheNodes) {
    Builder builder = withLight(R"({"type": "point"})");
    builder.json["nodes"] = Json::parse(R"([{"children": [2]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}},
                                            {"extensions": {"KHR_lights_punctual": {"light": 1}}}])");
    builder.json["scenes"][0]["nodes"] = Json::parse("[0, 1]");
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::parse(R"([{"type": "point", "name": "a"}, {"type": "point", "name": "b"}])");
    const Scene scene = builder.import();
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].name, "b");
    EXPECT_EQ(scene.lights[1].name, "a");
}

TEST(GltfLights, thoseThatBlenderExportedAreReadInWatts) {
    const auto builderOf = [](const char* generator, const char* type) {
        Builder builder = withLight(R"({"type": "point", "intensity": 6830})");
        builder.json["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = type;
        if (*generator != '\0') builder.json["asset"]["generator"] = generator;
        return builder;
    };
    struct Case {
        const char* generator;
        const char* type;
        float watts;
    };
    for (const Case& one :
         {Case{"Khronos glTF Blender I/O v4.2.57", "point", 10.0f},
          Case{"Khronos glTF Blender I/O v3.6.28", "directional", 10.0f},
          Case{"Khronos glTF Blender I/O v3.3.11", "directional", 6830.0f},
          Case{"Khronos glTF Blender I/O v3.3.11", "point", 10.0f}, Case{"Khronos glTF Blender I/O", "point", 10.0f},
          Case{"Another Blender", "point", 6830.0f}, Case{"", "point", 6830.0f}}) {
        SCOPED_TRACE(std::string(one.generator) + " " + one.type);
        Builder builder = builderOf(one.generator, one.type);
        const Scene scene = builder.import();
        EXPECT_FLOAT_EQ(scene.lights.at(0).intensity, one.watts);
        EXPECT_EQ(scene.notes.size(), std::string(one.generator).find("I/O") == std::string::npos ? 0u : 1u);
        builder.wishes.lightUnits = LightUnits::Watt;
        EXPECT_EQ(builder.import().lights.at(0).intensity, 6830.0f);
        EXPECT_TRUE(builder.import().notes.empty());
        builder.wishes.lightUnits = LightUnits::Lumen;
        EXPECT_FLOAT_EQ(builder.import().lights.at(0).intensity, 10.0f);
    }
}

TEST(GltfLights, whatAClipMakesOfTheIntensityOfOneInLumensIsInWattsToo) {
    Builder builder = withLight(R"({"type": "point", "intensity": 6830})");
    builder.wishes.lightUnits = LightUnits::Lumen;
    const int times = builder.add(std::vector<float>{0, 1}, 5126, "SCALAR", 2);
    const int values = builder.add(std::vector<float>{683, 1366}, 5126, "SCALAR", 2);
    Json& animation = builder.json["animations"][0];
    animation["samplers"][0] = {{"input", times}, {"output", values}};
    for (const char* property : {"intensity", "range"}) { // of one sampler, and only one of them counts lumens
        const std::string pointer = std::string("/extensions/KHR_lights_punctual/lights/0/") + property;
        animation["channels"].push_back(
            {{"sampler", 0},
             {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
    }
    const Clip clip = builder.import().rig.clips.at(0);
    ASSERT_EQ(clip.channels.size(), 2u);
    for (const AnimationChannel& channel : clip.channels) {
        const std::vector<float>& numbers = clip.samplers.at(std::size_t(channel.sampler)).values;
        const bool isIntensity = channel.property == AnimatedProperty::LightIntensity;
        EXPECT_FLOAT_EQ(numbers.at(1), isIntensity ? 2.0f : 1366.0f);
    }
}

TEST(GltfLights, ofChannelsThatChangeTheSameThingTheLastCountsAndOnlyItIsCharged) {
    // A light that many nodes carry, and as many channels that change it.
    constexpr int kNodes = 2000, kChannels = 20000;
    Builder builder = withLight(R"({"type": "point", "intensity": 3})");
    const Json carrier = {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    for (int node = 1; node < kNodes; ++node) {
        builder.json["scenes"][0]["nodes"].push_back(builder.json["nodes"].size());
        builder.json["nodes"].push_back(carrier);
    }
    const int times = builder.add(std::vector<float>{0, 1}, 5126, "SCALAR", 2);
    Json animation;
    for (const float watts : {1.0f, 7.0f}) {
        const int values = builder.add(std::vector<float>{watts, watts}, 5126, "SCALAR", 2);
        animation["samplers"].push_back({{"input", times}, {"output", values}});
    }
    Json channel = {
        {"sampler", 0},
        {"target",
         {{"path", "pointer"},
          {"extensions",
           {{"KHR_animation_pointer", {{"pointer", "/extensions/KHR_lights_punctual/lights/0/intensity"}}}}}}}};
    Json channels = Json::array();
    for (int i = 0; i < kChannels; ++i) channels.push_back(channel);
    // The same place, written another way.
    channel["sampler"] = 1;
    channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
        "/extensions/KHR_lights_punctual/lights/00/intensity";
    channels.push_back(channel);
    animation["channels"] = channels;
    builder.json["animations"] = Json::array({animation});
    // 40 million channels of the scene would be refused.
    const Scene scene = underLedger(importGltf, builder.folder.write("model.gltf", builder.json.dump()), 1024 * kMiB);
    const Clip& clip = scene.rig.clips.at(0);
    EXPECT_EQ(clip.channels.size(), scene.lights.size());
    EXPECT_GE(clip.channels.size(), std::size_t(kNodes));
    ASSERT_EQ(clip.samplers.size(), 1u) << "those that do not count are not read";
    EXPECT_FLOAT_EQ(clip.samplers[0].values.at(0), 7.0f);
}

// ---- Instances -----------------------------------------------------------------------------------------------------

/// Node 0 draws two instances of the triangle, the second turned by a quarter about Y and twice as large; node 1 after
/// it is empty.
Builder withInstances() {
    Builder builder =
        withNodes(R"([{"name": "tree", "mesh": 0, "translation": [0, 5, 0]}, {"name": "last"}])", "[0, 1]");
    constexpr int kSignedByte = 5120;
    Json& attributes = builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const int translations = builder.add(std::vector<float>{1, 0, 0, 2, 0, 0}, 5126, "VEC3", 2);
    // Normalised bytes: 90 / 127 is about the sine of an eighth turn, and the quaternion's length does not matter.
    const int rotations =
        builder.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 90, 0, 90}, kSignedByte, "VEC4", 2, true);
    const int scales = builder.add(std::vector<float>{1, 1, 1, 2, 2, 2}, 5126, "VEC3", 2);
    attributes = {{"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
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
    Json& attributes = builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["SCALE"] = builder.add(std::vector<float>{3, 3, 3, 3, 3, 3}, 5126, "VEC3", 2);
    EXPECT_FLOAT_EQ(builder.import().materials.at(0).thicknessMetres, 1.5f);
}

TEST(GltfInstances, attributesThatPlaceNothingAreRefusedByName) {
    const auto errorWith = [](const char* attribute, const std::vector<float>& values, const char* type,
                              std::size_t count) {
        Builder builder = withInstances();
        const int accessor = builder.add(values, 5126, type, count);
        builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"][attribute] = accessor;
        return builder.error();
    };
    EXPECT_NE(errorWith("TRANSLATION", {1, 2, 3}, "VEC3", 1)
                  .find("/TRANSLATION: accessor 4 has 1 elements, but there "
                        "are 2 instances"),
              std::string::npos);
    EXPECT_NE(errorWith("SCALE", {1, 2}, "SCALAR", 2).find("/SCALE: accessor 4 has 1 components"), std::string::npos);
    EXPECT_NE(errorWith("ROTATION", {0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 2).find("element 1 is the zero quaternion"),
              std::string::npos);
    Builder none = withInstances();
    none.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = Json::object();
    EXPECT_NE(none.error().find("holds nothing that says how many instances there are"), std::string::npos);
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
