#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "scenes/Pose.h"
#include "scenes/RigLinks.h"
#include "scenes/write/SceneText.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kFloatType = 5126, kShortType = 5122, kUnsignedByteType = 5121, kUnsignedShortType = 5123;
constexpr float kHalf = 0.70710678f;

/// Adds a clip with one channel.
void addClip(Builder& builder, const std::vector<float>& times, int output, Json target,
             const char* interpolation = "LINEAR", const char* name = "clip") {
    const int input = builder.add(times, kFloatType, "SCALAR", times.size());
    builder.json["animations"].push_back(
        {{"name", name},
         {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
         {"channels", Json::array({{{"sampler", 0}, {"target", std::move(target)}}})}});
}

/// A triangle that moves 2 along x within a second.
Builder movingTriangle() {
    Builder builder;
    const int output = builder.add(std::vector<float>{0, 0, 0, 2, 0, 0}, kFloatType, "VEC3", 2);
    addClip(builder, {0, 1}, output, {{"node", 0}, {"path", "translation"}});
    return builder;
}

/// The triangle with a skin of joints 1 and 2, of which 2 is a child of 1, 1 along x. Every vertex follows joint 2.
Builder skinnedTriangle() {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0, "translation": [7, 7, 7]}, {"children": [2]},
                                {"translation": [1, 0, 0]}],
                      "scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2]}]})");
    Json& attributes = builder.primitive()["attributes"];
    attributes["JOINTS_0"] =
        builder.add(std::vector<std::uint8_t>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kUnsignedByteType, "VEC4", 3);
    attributes["WEIGHTS_0"] =
        builder.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kFloatType, "VEC4", 3);
    return builder;
}

/// Places of the vertices that the scene draws, at a time.
std::vector<glm::dvec3> drawnAt(Scene scene, double timeSeconds) {
    checkScene(scene);
    poseScene(scene, timeSeconds);
    checkScene(scene);
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::vector<glm::dvec3> places;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const MeshInstance& instance : scene.nodes[node].instances)
            for (const glm::vec3& positionOS : scene.meshes[std::size_t(instance.mesh)].positionsOS)
                places.emplace_back(worldFromNode[node] * glm::dvec4(positionOS, 1.0));
    return places;
}

void expectPlace(const glm::dvec3& found, const glm::dvec3& wanted) {
    EXPECT_NEAR(found.x, wanted.x, 1e-6);
    EXPECT_NEAR(found.y, wanted.y, 1e-6);
    EXPECT_NEAR(found.z, wanted.z, 1e-6);
}

// ---- Clips ---------------------------------------------------------------------------------------------------------

TEST(GltfAnimation, aNodeMovesAsItsChannelsSay) {
    const Scene scene = movingTriangle().import();
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.rig.playing, std::vector{0});
    expectPlace(drawnAt(scene, 0.25)[0], {0.5, 0.0, 0.0});
    expectPlace(drawnAt(scene, 9.0)[1], {3.0, 0.0, 0.0});
    EXPECT_EQ(clipText(scene), "clip 0 'clip' of 1, 1 s");
}

TEST(GltfAnimation, ofChannelsThatChangeTheSameThingTheLastIsKept) {
    Builder builder = movingTriangle();
    Json& clip = builder.json["animations"][0];
    const Json channel = clip["channels"][0];
    clip["samplers"].push_back(clip["samplers"][0]);
    clip["samplers"][1]["output"] = builder.add(std::vector<float>{0, 0, 0, 0, 8, 0}, kFloatType, "VEC3", 2);
    for (int i = 0; i < 99; ++i) clip["channels"].push_back(channel);
    clip["channels"].push_back(channel);
    clip["channels"].back()["sampler"] = 1;
    const Scene scene = builder.import();
    EXPECT_EQ(scene.rig.clips.at(0).channels.size(), 1u);
    expectPlace(drawnAt(scene, 0.5)[0], {0.0, 4.0, 0.0});
}

TEST(GltfAnimation, normalizedIntegersAreFractions) {
    Builder builder;
    const int output =
        builder.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}, kShortType, "VEC4", 2, true);
    addClip(builder, {0, 1}, output, {{"node", 0}, {"path", "rotation"}});
    expectPlace(drawnAt(builder.import(), 1.0)[1], {-1.0, 0.0, 0.0});
    Builder plain;
    const int integers = plain.add(std::vector<std::int16_t>{0, 0, 0, 1, 0, 0, 1, 0}, kShortType, "VEC4", 2);
    addClip(plain, {0, 1}, integers, {{"node", 0}, {"path", "rotation"}});
    EXPECT_THAT(plain.error(), HasSubstr("/animations/0/samplers/0/output: accessor 1 holds integers that are not "
                                         "normalized"));
}

TEST(GltfAnimation, keyTimesThatDoNotAscendAreRefusedByName) {
    const auto errorWith = [](const std::vector<float>& times) {
        Builder builder;
        const int output = builder.add(std::vector<float>(3 * times.size(), 0.0f), kFloatType, "VEC3", times.size());
        addClip(builder, times, output, {{"node", 0}, {"path", "scale"}});
        return builder.error();
    };
    EXPECT_EQ(errorWith({0, 1, 2}), "");
    EXPECT_THAT(errorWith({0, 1, 1}), HasSubstr("/animations/0/samplers/0/input: accessor 2 has key 1 at 1 s and key "
                                                "2 at 1 s; key times must ascend"));
    EXPECT_THAT(errorWith({0, 2, 1}), HasSubstr("has key 1 at 2 s and key 2 at 1 s"));
    EXPECT_THAT(errorWith({0, std::numeric_limits<float>::quiet_NaN()}), HasSubstr("key times must be finite"));
}

TEST(GltfAnimation, valuesThatCannotBeAreRefusedByName) {
    const auto errorWith = [](const std::vector<float>& values, const char* type, std::size_t count, const char* path,
                              const char* interpolation = "LINEAR") {
        Builder builder;
        const int output = builder.add(values, kFloatType, type, count);
        addClip(builder, {0, 1}, output, {{"node", 0}, {"path", path}}, interpolation);
        return builder.error();
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(errorWith({0, 0, 0, 0, nan, 0}, "VEC3", 2, "translation"), HasSubstr("holds nan in element 1"));
    EXPECT_THAT(errorWith({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 2, "rotation"),
                HasSubstr("has the zero quaternion at key 1"));
    EXPECT_THAT(errorWith({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 2, "scale"),
                HasSubstr("has 4 components an element; scale needs 3"));
    EXPECT_THAT(errorWith({0, 0, 0, 0, 0, 0}, "VEC3", 2, "scale", "CUBICSPLINE"),
                HasSubstr("has 2 elements, but 2 keys of scale need 6"));
}

TEST(GltfAnimation, aHundredThousandKeysOfAFileAreFollowed) {
    constexpr std::size_t kKeys = 100'000;
    Builder builder;
    std::vector<float> times, values;
    for (std::size_t key = 0; key < kKeys; ++key) {
        times.push_back(float(key));
        values.insert(values.end(), {float(key % 1000), 0.0f, 0.0f});
    }
    addClip(builder, times, builder.add(values, kFloatType, "VEC3", kKeys), {{"node", 0}, {"path", "translation"}});
    const Scene scene = builder.import();
    for (const auto& [seconds, x] :
         {std::pair(-1.0, 0.0), std::pair(0.25, 0.25), std::pair(54'321.5, 321.5), std::pair(1e9, 999.0)})
        expectPlace(drawnAt(scene, seconds)[0], {x, 0.0, 0.0});
}

TEST(GltfAnimation, channelsThatCannotBeAreLeftOutWithOneWarning) {
    Builder builder = movingTriangle();
    Json& channels = builder.json["animations"][0]["channels"];
    for (const char* pointer :
         {"/nodes/0/extensions/KHR_node_visibility/visible", "/cameras/0/orthographic/xmag",
          "/nodes/1/extensions/KHR_node_visibility/visible", "/extensions/EXT_lights_image_based/lights/0/intensity"})
        channels.push_back(
            {{"sampler", 0},
             {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
    const Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0],
                HasSubstr("/animations: 4 channels change things that cannot be animated, and are left out: "
                          "/cameras/0/orthographic/xmag, /extensions/EXT_lights_image_based/lights/0/intensity, "
                          "/nodes/0/extensions/KHR_node_visibility/visible"));
    EXPECT_THAT(scene.warnings[0], Not(HasSubstr("/nodes/1"))) << "each kind is named once";
    expectPlace(drawnAt(scene, 1.0)[0], {2.0, 0.0, 0.0});
}

TEST(GltfAnimation, weightsOfMeshesWithoutTargetsAreLeftOutWithOneWarningByName) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "name": "face"}, {"name": "bone"}], "scenes": [{"nodes": [0, 1]}]})");
    builder.json["meshes"][0]["name"] = "head";
    const int output = builder.add(std::vector<float>{0, 1}, kFloatType, "SCALAR", 2);
    for (int clip = 0; clip < 2; ++clip) addClip(builder, {0, 1}, output, {{"node", 0}, {"path", "weights"}});
    Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0],
                HasSubstr("/animations: weights of node 'face' are animated, but its mesh 'head' has "
                          "no morph targets; they are left out"));
    EXPECT_TRUE(scene.rig.clips.at(0).channels.empty());
    addClip(builder, {0, 1}, output,
            {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/1/weights"}}}}}});
    scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("weights of node 'face' and 1 other node are animated"));
}

TEST(GltfAnimation, pointersReachLightsAndMaterials) {
    Builder builder;
    builder.material();
    builder.merge(R"({"nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
                      "scenes": [{"nodes": [0, 1]}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3}]}}})");
    const auto add = [&](const char* pointer, const std::vector<float>& values, const char* type) {
        const int output = builder.add(values, kFloatType, type, 2);
        addClip(builder, {0, 1}, output,
                {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}});
    };
    add("/extensions/KHR_lights_punctual/lights/0/intensity", {2, 6}, "SCALAR");
    add("/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 1, 1, 0.5f, 0, 1}, "VEC4");
    add("/materials/0/emissiveFactor", {0, 0, 0, 0, 2, 0}, "VEC3");
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    scene.rig.playing = {0, 1, 2};
    poseScene(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 4.0f);
    EXPECT_FLOAT_EQ(scene.materials[0].baseColor.y, 0.25f);
    EXPECT_FLOAT_EQ(scene.materials[0].emissive.y, 1.0f);
    playClip(scene, "none");
    poseScene(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 3.0f);
    EXPECT_FLOAT_EQ(scene.materials[0].baseColor.y, 1.0f);
}

/// Its keys state it in the space of the mesh, as the material does. A sampler that another channel takes as well keeps
/// its numbers there.
TEST(GltfAnimation, aThicknessIsScaledAsTheNodesThatShowIt) {
    const auto posed = [](const char* nodes) {
        Builder builder;
        builder.material().merge_patch(Json::parse(R"({"extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 2}}})"));
        builder.json["nodes"] = Json::parse(nodes);
        const int output = builder.add(std::vector<float>{0.25f, 0.75f}, kFloatType, "SCALAR", 2);
        const auto at = [](const char* path) {
            const std::string pointer = std::string("/materials/0/") + path;
            return Json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        };
        addClip(builder, {0, 1}, output, at("extensions/KHR_materials_volume/thicknessFactor"));
        builder.json["animations"][0]["channels"].push_back(
            {{"sampler", 0}, {"target", at("pbrMetallicRoughness/roughnessFactor")}});
        Scene scene = builder.import();
        EXPECT_EQ(scene.rig.clips.at(0).channels.size(), 2u);
        poseScene(scene, 0.5);
        EXPECT_FLOAT_EQ(scene.materials.at(0).perceptualRoughness, 0.5f);
        return scene.materials.at(0).thicknessMetres;
    };
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0}])"), 0.5f);
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0, "scale": [3, 3, 3]}])"), 1.5f);
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0, "scale": [1, 2, 3]}])"), 0.5f) << "in metres, with a warning";
}

TEST(GltfAnimation, pointersReachEveryNumberOfASpotLight) {
    Builder builder;
    builder.merge(R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}], "scenes": [{"nodes": [0]}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3, "range": 9,
                          "spot": {"innerConeAngle": 0.125, "outerConeAngle": 0.25}}]}}})");
    const auto add = [&](const char* path, const std::vector<float>& values, const char* type) {
        const std::string pointer = std::string("/extensions/KHR_lights_punctual/lights/0/") + path;
        const int output = builder.add(values, kFloatType, type, 2);
        addClip(builder, {0, 1}, output,
                {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}});
    };
    add("color", {0, 0, 0, 1, 0.5f, 0}, "VEC3");
    add("range", {2, 4}, "SCALAR");
    add("spot/innerConeAngle", {0, 1}, "SCALAR");
    add("spot/outerConeAngle", {0.5f, 1}, "SCALAR");
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    const auto cones = [&](std::vector<int> playing, double timeSeconds) {
        scene.rig.playing = std::move(playing);
        poseScene(scene, timeSeconds);
        EXPECT_NO_THROW(checkScene(scene));
        return glm::vec2(scene.lights[0].innerConeRadians, scene.lights[0].outerConeRadians);
    };
    EXPECT_EQ(cones({0, 1, 2, 3}, 0.5), glm::vec2(0.5f, 0.75f));
    EXPECT_EQ(scene.lights[0].color, glm::vec3(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(scene.lights[0].rangeMetres, 3.0f);
    playClip(scene, "none");
    EXPECT_EQ(cones({}, 0.0), glm::vec2(0.125f, 0.25f)) << "at rest again";
    EXPECT_EQ(cones({2}, 1.0), glm::vec2(0.25f)) << "the inner cone stays within the outer one";
    EXPECT_EQ(cones({2}, 0.0), glm::vec2(0.0f, 0.25f));
}

/// Adds a clip of what a pointer names, from the values at 0 s to as many at 1 s.
void addPointer(Builder& builder, const std::string& pointer, const std::vector<float>& values) {
    constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const int output = builder.add(values, kFloatType, kTypes[values.size() / 2 - 1], 2);
    addClip(builder, {0, 1}, output,
            {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}});
}

/// All clips of a scene at a time.
void poseAll(Scene& scene, double timeSeconds) {
    scene.rig.playing.clear();
    for (std::size_t clip = 0; clip < scene.rig.clips.size(); ++clip) scene.rig.playing.push_back(int(clip));
    poseScene(scene, timeSeconds);
    EXPECT_NO_THROW(checkScene(scene));
}

TEST(GltfAnimation, pointersReachEveryNumberOfAMaterialInTheTable) {
    Builder builder;
    builder.material();
    std::size_t clips = 0;
    const auto least = [](const AnimatedPropertyInfo& info) {
        return info.path.ends_with("ior") || info.path.ends_with("Ior") ? 1.0f : 0.0f;
    };
    for (const AnimatedPropertyInfo& info : animatedProperties()) {
        if (info.owner != AnimatedOwner::Material || info.property == AnimatedProperty::EmissiveStrength) continue;
        std::vector<float> values(std::size_t(info.width), least(info) + 0.25f);
        values.resize(2 * values.size(), least(info) + 0.75f);
        addPointer(builder, fmt::format("/materials/0/{}", info.path), values);
        ++clips;
    }
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ASSERT_EQ(scene.rig.numbers.size(), clips);
    const Material atRest = scene.materials[0];
    poseAll(scene, 0.5);
    for (const AnimatedPropertyInfo& info : animatedProperties()) {
        if (info.owner != AnimatedOwner::Material) continue;
        const float wanted = least(info) + 0.5f;
        std::visit(
            [&](auto member) {
                if constexpr (requires { scene.materials[0].*member; }) {
                    const auto& value = scene.materials[0].*member;
                    EXPECT_EQ(value, std::decay_t<decltype(value)>(wanted)) << info.path;
                }
            },
            info.member);
    }
    playClip(scene, "none");
    EXPECT_EQ(scene.materials[0], atRest);
}

TEST(GltfAnimation, emissionIsTheProductOfItsFactorAndItsStrengthAtEachTime) {
    const std::string factor = "/materials/0/emissiveFactor",
                      strength = "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength";
    const auto emissionWith = [&](const std::vector<std::pair<std::string, std::vector<float>>>& channels) {
        Builder builder;
        builder.material() = Json::parse(R"({"emissiveFactor": [1, 0.5, 0],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
        for (const auto& [pointer, values] : channels) addPointer(builder, pointer, values);
        Json& animations = builder.json["animations"];
        while (animations.size() > 1) { // into one clip
            const Json last = animations.back();
            animations.erase(animations.size() - 1);
            Json channel = last["channels"][0];
            channel["sampler"] = animations[0]["samplers"].size();
            animations[0]["samplers"].push_back(last["samplers"][0]);
            animations[0]["channels"].push_back(channel);
        }
        Scene scene = builder.import();
        EXPECT_TRUE(scene.warnings.empty());
        EXPECT_EQ(scene.materials[0].emissive, glm::vec3(4.0f, 2.0f, 0.0f));
        poseAll(scene, 0.5);
        const glm::vec3 emission = scene.materials[0].emissive;
        playClip(scene, "none");
        EXPECT_EQ(scene.materials[0].emissive, glm::vec3(4.0f, 2.0f, 0.0f)) << "at rest again";
        return emission;
    };
    const std::vector<float> red{0, 0, 0, 1, 0, 0}, stronger{2, 4};
    EXPECT_EQ(emissionWith({{factor, red}}), glm::vec3(2.0f, 0.0f, 0.0f));
    EXPECT_EQ(emissionWith({{strength, stronger}}), glm::vec3(3.0f, 1.5f, 0.0f));
    EXPECT_EQ(emissionWith({{factor, red}, {strength, stronger}}), glm::vec3(1.5f, 0.0f, 0.0f));
    EXPECT_EQ(emissionWith({{strength, stronger}, {factor, red}}), glm::vec3(1.5f, 0.0f, 0.0f)) << "in any order";
}

TEST(GltfAnimation, whatAnUnlitMaterialDoesNotShowIsPassedOverInSilence) {
    Builder builder;
    builder.material() = Json::parse(R"({"extensions": {"KHR_materials_unlit": {}}})");
    addPointer(builder, "/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1});
    addPointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 1, 1, 1, 1, 1});
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.rig.numbers.size(), 1u);
    poseAll(scene, 0.5);
    EXPECT_EQ(scene.materials[0].baseColor.x, 0.5f);
}

TEST(GltfAnimation, pointersMoveTurnAndScaleEachTextureOfAMaterialByItself) {
    Builder builder;
    builder.addTexture();
    builder.material() = Json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}}})");
    const std::string color = "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/";
    addPointer(builder, color + "offset", {0, 0, 1, 3});
    addPointer(builder, color + "scale", {1, 1, 3, -2});
    addPointer(builder, color + "rotation", {-1, 2});
    addPointer(builder, "/materials/0/normalTexture/extensions/KHR_texture_transform/offset", {0, 0, 0, 8});
    addPointer(builder, "/materials/0/emissiveTexture/extensions/KHR_texture_transform/offset", {0, 0, 0, 8});
    Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("/materials/0/emissiveTexture/extensions")) << "it has no such texture";
    const Material atRest = scene.materials[0];
    poseAll(scene, 0.5);
    const Material& posed = scene.materials[0];
    EXPECT_EQ(posed.texture(TextureSlot::BaseColor).transform,
              (TextureTransform{glm::vec2(0.5f, 1.5f), glm::vec2(2.0f, -0.5f), 0.5f}));
    EXPECT_EQ(posed.texture(TextureSlot::Normal).transform.offset, glm::vec2(0.0f, 4.0f));
    EXPECT_EQ(restingMaterials(scene)[0], atRest);
    playClip(scene, "none");
    EXPECT_EQ(scene.materials[0], atRest);
}

TEST(GltfAnimation, pointersReachTheLensesOfCameras) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0}, {"camera": 0}, {"camera": 1}, {"camera": 1}],
                      "scenes": [{"nodes": [0, 1, 2, 3]}],
                      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5}},
                                  {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": -2, "znear": 0,
                                                                            "zfar": 10}}]})");
    addPointer(builder, "/cameras/0/perspective/yfov", {0.5f, 1.5f});
    addPointer(builder, "/cameras/0/perspective/zfar", {0, 1}); // not beyond the near plane
    addPointer(builder, "/cameras/1/orthographic/ymag", {-2, -4});
    addPointer(builder, "/cameras/1/orthographic/znear", {0, 1});
    addPointer(builder, "/cameras/1/orthographic/zfar", {8, 4});
    addPointer(builder, "/cameras/1/perspective/yfov", {1, 2}); // it has none
    Scene scene = builder.import();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(scene.warnings[0], HasSubstr("1 channel changes something that cannot be animated, and is left out: "
                                             "/cameras/1/perspective/yfov"));
    ASSERT_EQ(scene.cameras.size(), 3u);
    const std::vector<Camera> atRest = scene.cameras;
    poseAll(scene, 0.5);
    EXPECT_EQ(scene.cameras[0].fovYRadians, 1.0);
    EXPECT_GT(scene.cameras[0].farMetres, 0.5);
    EXPECT_LT(scene.cameras[0].farMetres, 0.51);
    for (const std::size_t camera : {1u, 2u}) {
        EXPECT_EQ(scene.cameras[camera].halfHeightMetres, 3.0);
        EXPECT_EQ(scene.cameras[camera].nearMetres, 0.5);
        EXPECT_EQ(scene.cameras[camera].farMetres, 6.0);
    }
    playClip(scene, "none");
    EXPECT_EQ(scene.cameras, atRest);
    // Who says another lens than the model's owns it.
    const Camera before = scene.cameras[0];
    scene.cameras[0].fovYRadians = 0.25;
    ownCamera(scene, 0, before);
    poseAll(scene, 1.0);
    EXPECT_EQ(scene.cameras[0].fovYRadians, 0.25);
    EXPECT_EQ(scene.cameras[0].farMetres, 1.0);
    leaveLightsAndCameras(scene);
    poseAll(scene, 0.0);
    EXPECT_EQ(scene.cameras[1].halfHeightMetres, 4.0) << "as it was";
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

// ---- Skins ---------------------------------------------------------------------------------------------------------

TEST(GltfSkins, verticesFollowTheirJointsAndNotTheirNode) {
    Builder builder = skinnedTriangle();
    const int output = builder.add(std::vector<float>{0, 0, 0, 1, 0, 0, kHalf, kHalf}, kFloatType, "VEC4", 2);
    addClip(builder, {0, 1}, output, {{"node", 2}, {"path", "rotation"}});
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
    builder.json["skins"][0]["inverseBindMatrices"] = builder.add(matrices, kFloatType, "MAT4", 2);
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 0.0});
    builder.json["accessors"].back()["count"] = 1;
    EXPECT_THAT(builder.error(), HasSubstr("/skins/0/inverseBindMatrices: accessor 3 has 1 matrices for 2 joints"));
    builder.json["accessors"].back()["type"] = "VEC4";
    EXPECT_THAT(builder.error(), HasSubstr("accessor 3 must be of MAT4"));
}

TEST(GltfSkins, aVertexMayFollowEightJoints) {
    Builder builder = skinnedTriangle();
    Json& attributes = builder.primitive()["attributes"];
    attributes["JOINTS_1"] = builder.add(std::vector<std::uint16_t>(12, 0), kUnsignedShortType, "VEC4", 3);
    attributes["WEIGHTS_1"] =
        builder.add(std::vector<std::uint8_t>(12, 85), kUnsignedByteType, "VEC4", 3, true); // four thirds in all
    // 1 of joint 2 and 4/3 of joint 1.
    expectPlace(drawnAt(builder.import(), 0.0)[0], {1.0 / (1.0 + 4.0 / 3.0), 0.0, 0.0});
}

/// A chain of them, 1 mm each, whose middle one turns.
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
    builder.primitive()["attributes"]["JOINTS_0"] = builder.add(followed, kUnsignedShortType, "VEC4", 3);
    const int output = builder.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0}, kFloatType, "VEC4", 2);
    addClip(builder, {0, 1}, output, {{"node", kMiddle}, {"path", "rotation"}});
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
    spare.primitive()["attributes"]["JOINTS_0"] =
        spare.add(std::vector<std::uint8_t>{1, 200, 0, 0, 1, 200, 0, 0, 1, 200, 0, 0}, kUnsignedByteType, "VEC4", 3);
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
    expectPlace(places[0], {0.0, 0.0, 0.0}); // node 4, plain; skinned ones stand behind all nodes
    expectPlace(places[3], {1.0, 0.0, 0.0});
    expectPlace(places[6], {0.0, 0.0, 0.0});
}

// ---- Morph targets -------------------------------------------------------------------------------------------------

TEST(GltfMorphTargets, weightsOfTheNodeGoBeforeThoseOfTheMesh) {
    Builder builder;
    builder.primitive()["targets"] = Json::array({Json::object(
        {{"POSITION", builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloatType, "VEC3", 3)}})});
    EXPECT_TRUE(builder.import().rig.deformed.empty()) << "nothing can move it";
    builder.json["meshes"][0]["weights"] = Json::array({0.5});
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 0.5});
    builder.json["nodes"][0]["weights"] = Json::array({2});
    expectPlace(drawnAt(builder.import(), 0.0)[1], {1.0, 0.0, 2.0});
}

TEST(GltfMorphTargets, everyAttributeIsMorphedAndWeightsAreAnimated) {
    Builder builder;
    Json& attributes = builder.primitive()["attributes"];
    attributes["NORMAL"] = builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloatType, "VEC3", 3);
    attributes["TANGENT"] =
        builder.add(std::vector<float>{1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, kFloatType, "VEC4", 3);
    attributes["TEXCOORD_0"] = builder.add(std::vector<float>{0, 0, 1, 0, 0, 1}, kFloatType, "VEC2", 3);
    attributes["COLOR_0"] = builder.add(std::vector<float>(12, 0.5f), kFloatType, "VEC4", 3);
    const int ones = builder.add(std::vector<float>(9, 1.0f), kFloatType, "VEC3", 3);
    builder.primitive()["targets"] = Json::array(
        {Json::object({{"POSITION", ones}}),
         {{"NORMAL", builder.add(std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0, 0}, kFloatType, "VEC3", 3)},
          {"TANGENT", builder.add(std::vector<float>{-1, 1, 0, 0, 0, 0, 0, 0, 0}, kFloatType, "VEC3", 3)},
          {"TEXCOORD_0", builder.add(std::vector<float>(6, 0.25f), kFloatType, "VEC2", 3)},
          {"COLOR_0", builder.add(std::vector<float>{1, 0, 0, 0, 0, 0, -1, 0, 0}, kFloatType, "VEC3", 3)}}});
    const int weights = builder.add(std::vector<float>{0, 0, 0.5f, 1}, kFloatType, "SCALAR", 4);
    addClip(builder, {0, 1}, weights, {{"node", 0}, {"path", "weights"}});
    Scene scene = builder.import();
    poseScene(scene, 1.0);
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positionsOS[1], glm::vec3(1.5f, 0.5f, 0.5f));
    EXPECT_NEAR(mesh.normalsOS[0].x, kHalf, 1e-6f);
    EXPECT_NEAR(mesh.tangentsOS[0].y, 1.0f, 1e-6f);
    EXPECT_EQ(mesh.tangentsOS[0].w, -1.0f);
    EXPECT_EQ(mesh.texCoords[0][0], glm::vec2(0.25f));
    EXPECT_EQ(mesh.colors[0], glm::vec4(1.0f, 0.5f, 0.5f, 0.5f));
    EXPECT_EQ(mesh.colors[2].x, 0.0f);
}

TEST(GltfMorphTargets, sparseTargetsWithoutAViewAddToTheirVerticesAlone) {
    Builder builder;
    const int indices = builder.addView(bytesOf(std::vector<std::uint16_t>{2, 0}));
    const int values = builder.addView(bytesOf(std::vector<float>{0, 0, 3}));
    builder.json["accessors"].push_back(
        {{"componentType", kFloatType},
         {"type", "VEC3"},
         {"count", 3},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShortType}}},
           {"values", {{"bufferView", values}}}}}});
    builder.primitive()["targets"] = Json::array({Json::object({{"POSITION", builder.json["accessors"].size() - 1}})});
    builder.json["nodes"][0]["weights"] = Json::array({1});
    const std::vector<glm::dvec3> places = drawnAt(builder.import(), 0.0);
    expectPlace(places[0], {0.0, 0.0, 0.0});
    expectPlace(places[2], {0.0, 1.0, 3.0});
}

TEST(GltfMorphTargets, flatNormalsFollowTheDeformedTriangle) {
    Builder builder;
    builder.primitive()["indices"] = builder.add(std::vector<std::uint8_t>{2, 0, 1}, kUnsignedByteType, "SCALAR", 3);
    builder.primitive()["targets"] = Json::array({Json::object(
        {{"POSITION", builder.add(std::vector<float>{0, 0, 0, 0, 0, 1, 0, 0, 0}, kFloatType, "VEC3", 3)}})});
    builder.json["nodes"][0]["weights"] = Json::array({1});
    Scene scene = builder.import();
    poseScene(scene, 0.0);
    // (0,0,0) (1,0,1) (0,1,0): the plane x = z.
    for (const glm::vec3& normalOS : scene.meshes.at(0).normalsOS) {
        EXPECT_NEAR(normalOS.x, -kHalf, 1e-6f);
        EXPECT_NEAR(normalOS.z, kHalf, 1e-6f);
    }
}

TEST(GltfMorphTargets, anotherLengthIsRefusedByName) {
    Builder builder;
    builder.primitive()["targets"] =
        Json::array({Json::object({{"POSITION", builder.add(std::vector<float>(6, 0.0f), kFloatType, "VEC3", 2)}})});
    builder.json["nodes"][0]["weights"] = Json::array({1});
    EXPECT_THAT(builder.error(), HasSubstr("/meshes/0/primitives/0/targets/0/POSITION: accessor 1 of mesh 'mesh 0' "
                                           "has 2 elements, but there are 3 positions"));
}

// ---- Loading -------------------------------------------------------------------------------------------------------

TEST(GltfAnimation, aLoadedSceneStandsAtTimeZeroOfTheClipThatIsAskedFor) {
    Builder builder = movingTriangle();
    const int output = builder.add(std::vector<float>{0, 4, 0}, kFloatType, "VEC3", 1);
    addClip(builder, {0}, output, {{"node", 0}, {"path", "translation"}}, "STEP", "up");
    const std::string file = builder.folder.write("clips.gltf", builder.json.dump()).string();
    const auto placeWith = [&](std::optional<std::string> clip) {
        LoadOptions options;
        options.clip = std::move(clip);
        return glm::dvec3(loadScene(file, options).nodes[0].parentFromNode[3]);
    };
    expectPlace(placeWith({}), {0.0, 0.0, 0.0});
    expectPlace(placeWith("up"), {0.0, 4.0, 0.0});
    expectPlace(placeWith("1"), {0.0, 4.0, 0.0});
    expectPlace(placeWith("none"), {0.0, 0.0, 0.0});
    EXPECT_THROW(placeWith("2"), InputError);
}

TEST(GltfAnimation, clipsOfModelsThatASceneFileIncludesPlayTogetherAndFindTheirMaterials) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "name": "first"}, {"mesh": 1, "name": "second"}],
                      "scenes": [{"nodes": [0, 1]}], "materials": [{"name": "a"}, {"name": "b"}],
                      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                                 {"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}]})");
    const int output = builder.add(std::vector<float>{0.25f, 0.75f}, kFloatType, "SCALAR", 2);
    addClip(builder, {0, 1}, output,
            {{"path", "pointer"},
             {"extensions",
              {{"KHR_animation_pointer", {{"pointer", "/materials/1/pbrMetallicRoughness/metallicFactor"}}}}}});
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder
                                 .write("scene.json", std::string(R"({"tessera": 1,
        "include": [{"file": "model.gltf"}, {"file": "model.gltf", "name": "other"}],
        "materials": [{"name": "paint", "model": "lambert"}],
        "overrides": [{"node": "first", "material": "paint"}]})"))
                                 .string();
    Scene scene = loadScene(file);
    ASSERT_EQ(scene.rig.playing.size(), 2u);
    poseScene(scene, 1.0);
    int changed = 0;
    for (const Material& material : scene.materials) {
        EXPECT_FLOAT_EQ(material.metallic, material.name == "b" ? 0.75f : 1.0f) << material.name;
        changed += material.name == "b";
    }
    EXPECT_EQ(changed, 2);
}

TEST(GltfAnimation, whatASceneFileSaysOfAMaterialHoldsWhereNoClipPlays) {
    Builder builder;
    builder.material();
    const int output = builder.add(std::vector<float>{0.25f, 0.75f}, kFloatType, "SCALAR", 2);
    addClip(builder, {0, 1}, output,
            {{"path", "pointer"},
             {"extensions",
              {{"KHR_animation_pointer", {{"pointer", "/materials/0/pbrMetallicRoughness/metallicFactor"}}}}}});
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder
                                 .write("scene.json", std::string(R"({"tessera": 1, "base": {"file": "model.gltf"},
        "materials": [{"replaces": 0, "name": "gold", "model": "metallic_roughness", "metallic": 0.5}]})"))
                                 .string();
    EXPECT_EQ(loadScene(file).materials.at(0).metallic, 0.25f);
    LoadOptions still;
    still.clip = "none";
    EXPECT_EQ(loadScene(file, still).materials.at(0).metallic, 0.5f);
}

TEST(GltfAnimation, savingAPosedSceneWritesNoMaterialUnlessItWasEdited) {
    Builder builder;
    builder.material();
    const int output = builder.add(std::vector<float>{0.25f, 0.75f}, kFloatType, "SCALAR", 2);
    addClip(builder, {0, 1}, output,
            {{"path", "pointer"},
             {"extensions",
              {{"KHR_animation_pointer", {{"pointer", "/materials/0/pbrMetallicRoughness/metallicFactor"}}}}}});
    const std::string file = builder.folder.write("model.gltf", builder.json.dump()).string();
    const std::filesystem::path copy = std::filesystem::path(file).parent_path() / "saved.json";
    Scene scene = loadScene(file);
    const SceneOrigin origin = originOf(file, {}, scene);
    poseScene(scene, 1.0);
    EXPECT_EQ(scene.materials[0].metallic, 0.75f);
    EXPECT_FALSE(Json::parse(sceneText(scene, origin, copy)).contains("materials"));
    scene.materials[0].perceptualRoughness = 0.125f;
    const Json materials = Json::parse(sceneText(scene, origin, copy)).at("materials");
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(materials[0].value("metallic", 1.0f), 1.0f) << "at rest";
}

TEST(GltfAnimation, aSceneFileThatReplacesLightsAndCamerasLeavesTheOldOnesToNoClip) {
    Builder builder = movingTriangle();
    builder.merge(R"({"nodes": [{"mesh": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
                      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    builder.folder.write("model.gltf", builder.json.dump());
    const std::string file = builder.folder
                                 .write("scene.json", std::string(R"({"tessera": 1, "base": {"file": "model.gltf"},
        "lights": [{"type": "point", "position": [0, 3, 0]}],
        "cameras": [{"name": "own", "position": [0, 0, 9], "target": [0, 0, 0]}]})"))
                                 .string();
    Scene scene = loadScene(file);
    poseScene(scene, 1.0);
    expectPlace(scene.lights.at(0).positionWS, {0.0, 3.0, 0.0});
    expectPlace(glm::dvec3(scene.cameras.at(0).worldFromCamera[3]), {0.0, 0.0, 9.0});
    expectPlace(glm::dvec3(scene.nodes.at(0).parentFromNode[3]), {2.0, 0.0, 0.0});
}

TEST(GltfAnimation, deformedInstancesAreChargedBeforeTheyAreCopied) {
    const auto errorWith = [](int instances) {
        constexpr std::size_t kVertices = 3000;
        Builder builder = skinnedTriangle();
        Json& attributes = builder.primitive()["attributes"];
        attributes["POSITION"] = builder.add(std::vector<float>(3 * kVertices), kFloatType, "VEC3", kVertices);
        attributes["JOINTS_0"] =
            builder.add(std::vector<std::uint8_t>(4 * kVertices), kUnsignedByteType, "VEC4", kVertices);
        attributes["WEIGHTS_0"] = builder.add(std::vector<float>(4 * kVertices), kFloatType, "VEC4", kVertices);
        Json roots = Json::array({0, 1});
        for (int i = 0; i < instances; ++i) {
            roots.push_back(builder.json["nodes"].size());
            builder.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
        }
        builder.json["scenes"][0]["nodes"] = roots;
        try {
            underLedger(importGltf, builder.folder.write("many.gltf", builder.json.dump()), 64 * kMiB);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(errorWith(20), "");
    // 84 KB each
    EXPECT_THAT(errorWith(2000), HasSubstr("/nodes/"));
}

TEST(GltfAnimation, weightsOfNodesAreChargedByTargetsAndNodes) {
    const auto errorWith = [](int targets, int nodes) {
        Builder builder;
        const int moved = builder.add(std::vector<float>(9, 1.0f), kFloatType, "VEC3", 3);
        builder.primitive()["targets"] = Json::array();
        for (int i = 0; i < targets; ++i) builder.primitive()["targets"].push_back(Json::object({{"POSITION", moved}}));
        builder.json["meshes"][0]["weights"] = Json::array({1});
        builder.json["nodes"] = Json::array();
        builder.json["scenes"][0]["nodes"] = Json::array();
        for (int i = 0; i < nodes; ++i) {
            builder.json["nodes"].push_back(Json::object({{"mesh", 0}}));
            builder.json["scenes"][0]["nodes"].push_back(i);
        }
        try {
            underLedger(importGltf, builder.folder.write("many.gltf", builder.json.dump()), 64 * kMiB);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(errorWith(3000, 30), "");
    EXPECT_EQ(errorWith(30, 3000), "");
    // 108 MB beside what either takes: 36 KB a node
    EXPECT_THAT(errorWith(3000, 3000), HasSubstr("/nodes/"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
