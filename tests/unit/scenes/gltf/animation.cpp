// Clips of glTF files: channels of nodes, and refused or omitted ones.
#include <limits>

#include "scenes/Clips.h"
#include "tests/unit/scenes/gltf/AnimationBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

using testing::Not;

TEST(GltfAnimation, aNodeMovesAsItsChannelsSay) {
    const Scene scene = movingTriangle().import();
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.rig.playing, std::vector{0});
    expectPlace(drawnAt(scene, 0.25)[0], {0.5, 0.0, 0.0});
    expectPlace(drawnAt(scene, 9.0)[1], {3.0, 0.0, 0.0});
    EXPECT_EQ(clipText(scene), "clip 0 'clip' (the only one), 1 s");
}

TEST(GltfAnimation, ofChannelsThatChangeTheSameThingTheLastIsKept) {
    Builder builder = movingTriangle();
    Json& clip = builder.json["animations"][0];
    const Json channel = clip["channels"][0];
    clip["samplers"].push_back(clip["samplers"][0]);
    clip["samplers"][1]["output"] = builder.add("VEC3", {0, 0, 0, 0, 8, 0});
    for (int i = 0; i < 99; ++i) clip["channels"].push_back(channel);
    clip["channels"].push_back(channel);
    clip["channels"].back()["sampler"] = 1;
    const Scene scene = builder.import();
    EXPECT_EQ(scene.rig.clips.at(0).channels.size(), 1u);
    expectPlace(drawnAt(scene, 0.5)[0], {0.0, 4.0, 0.0});
}

TEST(GltfAnimation, aNodeAtRestWithoutRotationIsNotRotated) {
    Builder builder = movingTriangle();
    builder.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    const Scene scene = builder.import();
    EXPECT_TRUE(hasWarning(scene, "/nodes/0/rotation: is the zero quaternion"));
    expectPlace(drawnAt(scene, 0.5)[1], {2.0, 0.0, 0.0});
}

TEST(GltfAnimation, normalizedIntegersAreFractions) {
    Builder builder;
    animate<std::int16_t>(builder, 0, "rotation", "VEC4", {0, 0, 0, 32767, 0, 0, 32767, 0}, true);
    expectPlace(drawnAt(builder.import(), 1.0)[1], {-1.0, 0.0, 0.0});
    Builder plain;
    animate<std::int16_t>(plain, 0, "rotation", "VEC4", {0, 0, 0, 1, 0, 0, 1, 0});
    EXPECT_THAT(plain.error(),
                HasSubstr("/animations/0/samplers/0/output: accessor 1 holds integers that are not normalized"));
}

TEST(GltfAnimation, keyTimesThatDoNotAscendAreRefusedByName) {
    const auto errorWith = [](const std::vector<float>& times) {
        Builder builder;
        const int output = builder.add("VEC3", std::vector<float>(3 * times.size(), 0.0f));
        addClip(builder, times, output, {{"node", 0}, {"path", "scale"}});
        return builder.error();
    };
    EXPECT_EQ(errorWith({0, 1, 2}), "");
    EXPECT_THAT(errorWith({0, 1, 1}),
                HasSubstr("/animations/0/samplers/0/input: has key 1 at 1 s and key 2 at 1 s; key times must ascend"));
    EXPECT_THAT(errorWith({0, 2, 1}), HasSubstr("has key 1 at 2 s and key 2 at 1 s"));
    EXPECT_THAT(errorWith({0, std::numeric_limits<float>::quiet_NaN()}), HasSubstr("key times must be finite"));
}

TEST(GltfAnimation, valuesThatCannotBeAreRefusedByName) {
    const auto errorWith = [](const std::vector<float>& values, const char* type, const char* path,
                              const char* interpolation = "LINEAR") {
        Builder builder;
        const int output = builder.add(type, values);
        addClip(builder, {0, 1}, output, {{"node", 0}, {"path", path}}, interpolation);
        return builder.error();
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(errorWith({0, 0, 0, 0, nan, 0}, "VEC3", "translation"), HasSubstr("holds nan in element 1"));
    EXPECT_THAT(errorWith({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", "rotation"), HasSubstr("key 1 is the zero quaternion"));
    EXPECT_THAT(errorWith({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", "scale"),
                HasSubstr("has 4 components an element; scale needs 3"));
    EXPECT_THAT(errorWith({0, 0, 0, 0, 0, 0}, "VEC3", "scale", "CUBICSPLINE"),
                HasSubstr("has 2 elements, but 2 keys of scale need 6"));
}

/// A key of CUBICSPLINE is an in-tangent, a value and an out-tangent; zero tangents are valid.
TEST(GltfAnimation, ofACubicKeyTheValueAloneMustBeARotation) {
    const auto with = [](const std::vector<float>& values) {
        Builder builder = movingTriangle();
        builder.json["animations"] = Json::array();
        animate(builder, 0, "rotation", "VEC4", values, false, "CUBICSPLINE");
        return builder;
    };
    std::vector<float> values(24, 0.0f);
    values[4 + 3] = values[16 + 3] = 1.0f;
    EXPECT_NO_THROW(with(values).import());
    values[16 + 3] = 0.0f;
    values[12] = 1.0f; // its in-tangent
    EXPECT_THAT(with(values).error(), HasSubstr("key 1 is the zero quaternion"));
}

TEST(GltfAnimation, aHundredThousandKeysOfAFileAreFollowed) {
    constexpr std::size_t kKeys = 100'000;
    Builder builder;
    std::vector<float> times, values;
    for (std::size_t key = 0; key < kKeys; ++key) {
        times.push_back(float(key));
        values.insert(values.end(), {float(key % 1000), 0.0f, 0.0f});
    }
    addClip(builder, times, builder.add("VEC3", values), {{"node", 0}, {"path", "translation"}});
    const Scene scene = builder.import();
    for (const auto& [seconds, x] :
         {std::pair(-1.0, 0.0), std::pair(0.25, 0.25), std::pair(54'321.5, 321.5), std::pair(1e9, 999.0)})
        expectPlace(drawnAt(scene, seconds)[0], {x, 0.0, 0.0});
}

TEST(GltfAnimation, channelsThatCannotBeAreLeftOutWithOneWarning) {
    Builder builder = movingTriangle();
    Json& channels = builder.json["animations"][0]["channels"];
    for (const char* pointer : {"/nodes/0/extensions/KHR_node_selectability/selectable", "/cameras/0/orthographic/xmag",
                                "/nodes/1/extensions/KHR_node_selectability/selectable",
                                "/extensions/EXT_lights_image_based/lights/0/intensity"})
        channels.push_back({{"sampler", 0}, {"target", pointerTo(pointer)}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0],
                HasSubstr("/animations: 4 channels change things that cannot be animated, and are left out: "
                          "/cameras/0/orthographic/xmag, /extensions/EXT_lights_image_based/lights/0/intensity, "
                          "/nodes/0/extensions/KHR_node_selectability/selectable"));
    EXPECT_THAT(scene.warnings[0], Not(HasSubstr("/nodes/1"))) << "each kind is named once";
    expectPlace(drawnAt(scene, 1.0)[0], {2.0, 0.0, 0.0});
}

TEST(GltfAnimation, weightsOfMeshesWithoutTargetsAreLeftOutWithOneWarningByName) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "name": "face"}, {"name": "bone"}], "scenes": [{"nodes": [0, 1]}]})");
    builder.json["meshes"][0]["name"] = "head";
    const int output = builder.add("SCALAR", {0, 1});
    for (int clip = 0; clip < 2; ++clip) addClip(builder, {0, 1}, output, {{"node", 0}, {"path", "weights"}});
    Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0],
                HasSubstr("/animations: weights of node 'face' are animated, but its mesh 'head' has "
                          "no morph targets; they are left out"));
    EXPECT_TRUE(scene.rig.clips.at(0).channels.empty());
    addClip(builder, {0, 1}, output, pointerTo("/nodes/1/weights"));
    scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("weights of node 'face' and 1 other node are animated"));
}

TEST(GltfAnimation, lightsAndCamerasOnMovingNodesMove) {
    Builder builder = movingTriangle();
    builder.merge(R"({"nodes": [{"children": [1]}, {"mesh": 0, "camera": 0, "extensions":
                                {"KHR_lights_punctual": {"light": 0}}}, {"camera": 0}],
                      "scenes": [{"nodes": [0, 2]}],
                      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    Scene scene = builder.import();
    ASSERT_EQ(scene.rig.cameras.size(), 1u);
    ASSERT_EQ(scene.rig.lights.size(), 1u);
    poseScene(scene, 0.5);
    expectPlace(scene.lights[0].positionWS, {1.0, 0.0, 0.0});
    expectPlace(glm::dvec3(scene.cameras[0].worldFromCamera[3]), {1.0, 0.0, 0.0});
    expectPlace(glm::dvec3(scene.cameras[1].worldFromCamera[3]), {0.0, 0.0, 0.0});
}

} // namespace
} // namespace tessera::scenes::gltf::test
