// Properties that KHR_animation_pointer animates, of lights, materials, textures and cameras.

#include <fmt/format.h>

#include "scenes/Clips.h"
#include "scenes/Rest.h"
#include "scenes/RigLinks.h"
#include "tests/unit/scenes/gltf/AnimationBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

/// Poses a scene by all of its clips.
void poseAll(Scene& scene, double timeSeconds) {
    scene.rig.playing.clear();
    for (std::size_t clip = 0; clip < scene.rig.clips.size(); ++clip) scene.rig.playing.push_back(int(clip));
    poseScene(scene, timeSeconds);
    EXPECT_NO_THROW(checkScene(scene));
}

TEST(GltfAnimation, pointersReachLightsAndMaterials) {
    Builder builder;
    builder.material();
    builder.merge(R"({"nodes": [{"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
                      "scenes": [{"nodes": [0, 1]}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3}]}}})");
    addPointer(builder, "/extensions/KHR_lights_punctual/lights/0/intensity", {2, 6});
    addPointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 1, 1, 0.5f, 0, 1});
    addPointer(builder, "/materials/0/emissiveFactor", {0, 0, 0, 0, 2, 0});
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty());
    poseAll(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 4.0f);
    EXPECT_FLOAT_EQ(scene.materials[0].baseColor.y, 0.25f);
    EXPECT_FLOAT_EQ(scene.materials[0].emissive.y, 1.0f);
    playClip(scene, "none");
    poseScene(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 3.0f);
    EXPECT_FLOAT_EQ(scene.materials[0].baseColor.y, 1.0f);
}

/// Integers that are not normalised are plain numbers; glTF forbids them for properties of nodes.
TEST(GltfAnimation, pointersTakePlainIntegers) {
    Builder builder;
    builder.material();
    const int output = builder.add<std::uint8_t>("SCALAR", {0, 1});
    addClip(builder, {0, 1}, output, pointerTo("/materials/0/pbrMetallicRoughness/roughnessFactor"));
    Scene scene = builder.import();
    poseAll(scene, 0.5);
    EXPECT_FLOAT_EQ(scene.materials[0].perceptualRoughness, 0.5f);
}

/// Keys give the thickness in mesh space, as the material does. If another channel uses the same sampler, its values
/// stay unscaled there.
TEST(GltfAnimation, aThicknessIsScaledAsTheNodesThatShowIt) {
    const auto posed = [](const char* nodes) {
        Builder builder;
        builder.material().merge_patch(Json::parse(R"({"extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 2}}})"));
        builder.json["nodes"] = Json::parse(nodes);
        addPointer(builder, "/materials/0/extensions/KHR_materials_volume/thicknessFactor", {0.25f, 0.75f});
        builder.json["animations"][0]["channels"].push_back(
            {{"sampler", 0}, {"target", pointerTo("/materials/0/pbrMetallicRoughness/roughnessFactor")}});
        Scene scene = builder.import();
        EXPECT_EQ(scene.rig.clips.at(0).channels.size(), 2u);
        poseScene(scene, 0.5);
        EXPECT_FLOAT_EQ(scene.materials.at(0).perceptualRoughness, 0.5f);
        return scene.materials.at(0).thicknessMetres;
    };
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0}])"), 0.5f);
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0, "scale": [3, 3, 3]}])"), 1.5f);
    EXPECT_FLOAT_EQ(posed(R"([{"mesh": 0, "scale": [1, 2, 3]}])"), 0.5f) << "in metres, with a warning";
    const char* hidden = R"([{"mesh": 0, "scale": [3, 3, 3], "children": [1]}, {"mesh": 0, "scale": [0, 0, 0]}])";
    EXPECT_FLOAT_EQ(posed(hidden), 1.5f) << "nothing of scale 0 is visible";
}

TEST(GltfAnimation, pointersReachEveryNumberOfASpotLight) {
    Builder builder;
    builder.merge(R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}], "scenes": [{"nodes": [0]}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3, "range": 9,
                          "spot": {"innerConeAngle": 0.125, "outerConeAngle": 0.25}}]}}})");
    const auto add = [&](const char* path, const std::vector<float>& values) {
        addPointer(builder, std::string("/extensions/KHR_lights_punctual/lights/0/") + path, values);
    };
    add("color", {0, 0, 0, 1, 0.5f, 0});
    add("range", {2, 4});
    add("spot/innerConeAngle", {0, 1});
    add("spot/outerConeAngle", {0.5f, 1});
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

/// Booleans are steps whatever the sampler's interpolation. A node that a clip shows is in the scene although it is
/// hidden without the clip.
TEST(GltfAnimation, clipsHideAndShowNodesWithTheirMeshesAndLights) {
    Builder builder;
    builder.merge(R"({"nodes": [{"mesh": 0, "scale": [2, 2, 2]},
                                {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [0, 2]},
                                {"extensions": {"KHR_lights_punctual": {"light": 0}}},
                                {"mesh": 0, "skin": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}, {}],
                      "scenes": [{"nodes": [1, 3, 4]}], "skins": [{"joints": [4]}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3}]}}})");
    const int shown = builder.add<std::uint8_t>("SCALAR", {1, 0});
    for (const char* node : {"1", "3"})
        addClip(builder, {0, 1}, shown,
                pointerTo(fmt::format("/nodes/{}/extensions/KHR_node_visibility/visible", node)));
    Scene scene = builder.import();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    const auto shownMeshes = [&] {
        const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
        std::vector<double> scales;
        for (std::size_t node = 0; node < scene.nodes.size(); ++node)
            if (!scene.nodes[node].instances.empty()) scales.push_back(glm::length(glm::dvec3(worldFromNode[node][0])));
        return scales;
    };
    poseAll(scene, 0.75);
    EXPECT_THAT(shownMeshes(), ElementsAre(2.0, testing::Gt(0.5)));
    EXPECT_FLOAT_EQ(scene.lights.at(0).intensity, 3.0f);
    poseAll(scene, 1.0);
    EXPECT_THAT(shownMeshes(), ElementsAre(0.0, 0.0));
    EXPECT_EQ(scene.lights[0].intensity, 0.0f);
    playClip(scene, "none");
    poseScene(scene, 0.0);
    EXPECT_THAT(shownMeshes(), ElementsAre(0.0, testing::Gt(0.5)));
    EXPECT_EQ(scene.lights[0].intensity, 0.0f);
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
        while (animations.size() > 1) { // merges all into one clip
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
    addPointer(builder, "/cameras/1/perspective/yfov", {1, 2}); // an orthographic camera has none
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
    // An edited member of a camera is no longer animated.
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

} // namespace
} // namespace tessera::scenes::gltf::test
