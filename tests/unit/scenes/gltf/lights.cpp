#include <numbers>

#include "NodeBuilder.h"
#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/gltf/AnimationBuilder.h"

namespace tessera::scenes::gltf::test {
namespace {

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
    expectMembers(light, "color 1 0.5 0.25, intensity 40, rangeMetres 8, positionWS 1 2 3, enabled 1");
    EXPECT_TRUE(scene.warnings.empty());
    const Light plain = withLight(R"({"type": "point"})").import().lights.at(0);
    EXPECT_EQ(plain.name, "light 0");
    expectMembers(plain, "rangeMetres inf, intensity 1");
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
    for (const auto& [spot, members] :
         {std::pair(R"({"innerConeAngle": 0.25, "outerConeAngle": 0.5})",
                    "innerConeRadians 0.25, outerConeRadians 0.5"),
          {R"({"innerConeAngle": 0.5, "outerConeAngle": 0.5})", "innerConeRadians 0.5, outerConeRadians 0.5"},
          {"{}", "innerConeRadians 0"}}) {
        Builder builder = withLight((std::string(R"({"type": "spot", "spot": )") + spot + "}").c_str());
        builder.importOptions.isStrict = true;
        const Scene scene = builder.import();
        EXPECT_EQ(scene.lights.at(0).type, LightType::Spot);
        expectMembers(scene.lights[0], members);
        EXPECT_TRUE(scene.warnings.empty()) << spot;
    }
    EXPECT_FLOAT_EQ(withLight(R"({"type": "spot", "spot": {}})").import().lights.at(0).outerConeRadians,
                    std::numbers::pi_v<float> / 4);
}

TEST(GltfLights, conesAndRangesOutOfBoundsAreRepairedWithAWarningAndRefusedByAStrictLoad) {
    struct Case {
        const char* light;
        const char* warning;
        float inner, outer, range;
    };
    constexpr float kQuarter = std::numbers::pi_v<float> / 4, kHalf = std::numbers::pi_v<float> / 2;
    for (const Case& one :
         {Case{R"({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}})",
               "spot/innerConeAngle: is 1; it must be less than the outer angle, 0.5", 0.5f, 0.5f, kInfinity},
          Case{R"({"type": "spot", "spot": {"innerConeAngle": 0.8}})", "spot/innerConeAngle: is 0.8", kQuarter,
               kQuarter, kInfinity},
          Case{R"({"type": "spot", "spot": {"innerConeAngle": 2, "outerConeAngle": 1.7}})",
               "spot/outerConeAngle: is 1.7; it must be at most pi/2 radians; pi/2 is taken", kHalf, kHalf, kInfinity},
          Case{R"({"type": "spot", "range": 0, "spot": {}})", "range: is 0; it must be greater than 0", 0.0f, kQuarter,
               kInfinity}}) {
        SCOPED_TRACE(one.light);
        Builder builder = withLight(one.light);
        const Scene scene = builder.import();
        EXPECT_FLOAT_EQ(scene.lights.at(0).innerConeRadians, one.inner);
        EXPECT_FLOAT_EQ(scene.lights.at(0).outerConeRadians, one.outer);
        EXPECT_EQ(scene.lights.at(0).rangeMetres, one.range);
        ASSERT_FALSE(scene.warnings.empty());
        EXPECT_THAT(scene.warnings.at(0), HasSubstr(one.warning)) << scene.warnings.at(0);
        EXPECT_THAT(builder.error(), HasSubstr("KHR_lights_punctual/lights/0/"));
    }
}

TEST(GltfLights, impossibleLightIsRefused) {
    EXPECT_THAT(withLight(R"({"type": "lamp"})").error(),
                HasSubstr("lights/0/type: is 'lamp'; valid are directional, point, spot"));
    EXPECT_THAT(withLight(R"({"type": "point", "intensity": -1})").error(),
                HasSubstr("intensity: is -1; it must be at least 0"));
    EXPECT_THAT(withLight(R"({"type": "spot"})").error(),
                HasSubstr("lights/0: the required property 'spot' is missing"));
    Builder builder = withLight(R"({"type": "point"})");
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_THAT(builder.error(), HasSubstr("points at /extensions/KHR_lights_punctual/lights/1, but there are only 1"));
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
          Case{"Khronos glTF Blender I/O v3.4.50", "directional", 10.0f},
          Case{"Khronos glTF Blender I/O v3.3.11", "directional", 6830.0f},
          Case{"Khronos glTF Blender I/O v3.3.11", "point", 10.0f}, Case{"Khronos glTF Blender I/O", "point", 10.0f},
          Case{"Another Blender", "point", 6830.0f}, Case{"", "point", 6830.0f}}) {
        SCOPED_TRACE(std::string(one.generator) + " " + one.type);
        Builder builder = builderOf(one.generator, one.type);
        const Scene scene = builder.import();
        EXPECT_FLOAT_EQ(scene.lights.at(0).intensity, one.watts);
        EXPECT_EQ(scene.notes.size(), one.watts == 10.0f ? 1u : 0u) << "reports what it divides";
        builder.importOptions.lightUnits = LightUnits::Watt;
        EXPECT_EQ(builder.import().lights.at(0).intensity, 6830.0f);
        EXPECT_TRUE(builder.import().notes.empty());
        builder.importOptions.lightUnits = LightUnits::Lumen;
        EXPECT_FLOAT_EQ(builder.import().lights.at(0).intensity, 10.0f);
    }
}

TEST(GltfLights, whatAClipMakesOfTheIntensityOfOneInLumensIsInWattsToo) {
    Builder builder = withLight(R"({"type": "point", "intensity": 6830})");
    builder.importOptions.lightUnits = LightUnits::Lumen;
    const int times = builder.add("SCALAR", {0, 1}), values = builder.add("SCALAR", {683, 1366});
    Json& animation = builder.json["animations"][0];
    animation["samplers"][0] = {{"input", times}, {"output", values}};
    for (const char* property : {"intensity", "range"}) // both use one sampler, and only one is in lumens
        animation["channels"].push_back(
            {{"sampler", 0},
             {"target", pointerTo(std::string("/extensions/KHR_lights_punctual/lights/0/") + property)}});
    const Clip clip = builder.import().rig.clips.at(0);
    ASSERT_EQ(clip.channels.size(), 2u);
    for (const AnimationChannel& channel : clip.channels) {
        const std::vector<float>& numbers = clip.samplers.at(std::size_t(channel.sampler)).values;
        const bool isIntensity = channel.property == AnimatedProperty::LightIntensity;
        EXPECT_FLOAT_EQ(numbers.at(1), isIntensity ? 2.0f : 1366.0f);
    }
}

TEST(GltfLights, ofChannelsThatChangeTheSameThingTheLastCountsAndOnlyItIsCharged) {
    // A light on many nodes, and as many channels that animate it.
    constexpr int kNodes = 2000, kChannels = 20000;
    Builder builder = withLight(R"({"type": "point", "intensity": 3})");
    const Json carrier = {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    for (int node = 1; node < kNodes; ++node) {
        builder.json["scenes"][0]["nodes"].push_back(builder.json["nodes"].size());
        builder.json["nodes"].push_back(carrier);
    }
    const int times = builder.add("SCALAR", {0, 1});
    Json animation;
    for (const float watts : {1.0f, 7.0f}) {
        const int values = builder.add("SCALAR", {watts, watts});
        animation["samplers"].push_back({{"input", times}, {"output", values}});
    }
    Json channel = {{"sampler", 0}, {"target", pointerTo("/extensions/KHR_lights_punctual/lights/0/intensity")}};
    Json channels = Json::array();
    for (int i = 0; i < kChannels; ++i) channels.push_back(channel);
    // The same property, by another spelling of the pointer.
    channel["sampler"] = 1;
    channel["target"] = pointerTo("/extensions/KHR_lights_punctual/lights/00/intensity");
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

} // namespace
} // namespace tessera::scenes::gltf::test
