// The table of light types, and behaviour that follows from it.
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using LightTypes = test::SceneFiles;

/// Keys of a light type: all keys of its row, with each parameter at the fraction `share` of its range in scene files.
std::string keysOf(const LightTypeInfo& type, float share) {
    std::string keys = fmt::format(R"("type": "{}", "color": [1, 0.5, 0.25], "intensity": 2)", type.name);
    if (type.hasPosition()) keys += R"(, "position": [1, 2, 3], "falloff": {"type": "inverse_square", "range": 4})";
    if (type.hasDirection) keys += R"(, "direction": [0, -1, 0])";
    for (const LightParameter& parameter : type.parameters)
        keys += fmt::format(R"(, "{}": {})", parameter.key, glm::mix(parameter.least, parameter.most, share));
    if (const LightParameter* size = sizeParameter(type); size != nullptr && type.isArea)
        keys += fmt::format(R"(, "{}": {})", size->key, glm::mix(size->least, size->most, share));
    if (type.isTurned()) keys += R"(, "along": [0, 0, -2])";
    if (type.hasCorners()) keys += R"(, "corners": [[0, 0], [2, 0], [0.5, 0.25]])";
    if (type.isFlat) keys += R"(, "twoSided": true)";
    if (type.isArea) keys += R"(, "seen": false)";
    return keys;
}

std::string document(const std::string& keys) {
    return R"({"tessera": 1, "lights": [{)" + keys + "}]}";
}

TEST_F(LightTypes, namesKeysAndMembersAreNeverTheSame) {
    std::set<std::string_view> names, fields;
    for (const LightTypeInfo& type : lightTypes()) {
        EXPECT_TRUE(names.insert(type.name).second) << type.name;
        std::set<std::string_view> keys{"type",     "name",     "enabled",   "fields",    "color",     "intensity",
                                        "position", "falloff",  "animation", "direction", "target",    "along",
                                        "corners",  "twoSided", "seen",      "flicker",   "keyframes", "texture"};
        for (const LightParameter& parameter : type.parameters)
            EXPECT_TRUE(keys.insert(parameter.key).second) << type.name << " " << parameter.key;
    }
    visitFields(kLightFields, [&](const auto& field) { EXPECT_TRUE(fields.insert(field.name).second) << field.name; });
}

TEST_F(LightTypes, everyTypeReadsTheKeysOfItsRow) {
    for (const LightTypeInfo& type : lightTypes()) {
        SCOPED_TRACE(type.name);
        for (const float share : {0.0f, 0.5f, 1.0f}) {
            const std::string text = document(keysOf(type, share));
            EXPECT_TRUE(test::schemaAccepts(text)) << text;
            const Light light = folder.import(text).lights[0];
            EXPECT_EQ(light.type, type.type);
            if (type.hasPosition()) {
                EXPECT_EQ(light.positionWS, glm::dvec3(1, 2, 3));
                EXPECT_EQ(light.rangeMetres, 4.0f);
            }
            if (type.hasDirection) {
                EXPECT_EQ(light.directionWS, glm::dvec3(0, -1, 0));
            }
            for (const LightParameter& parameter : type.parameters) {
                const float value = glm::mix(parameter.least, parameter.most, share);
                const bool isAngle = parameter.kind == LightParameter::Kind::Angle;
                EXPECT_FLOAT_EQ(light.*parameter.member, isAngle ? glm::radians(value) : value) << parameter.key;
            }
            EXPECT_EQ(light.isTwoSided, type.isFlat);
            EXPECT_EQ(light.isSeen, !type.isArea);
            EXPECT_EQ(light.alongWS, type.isTurned() ? glm::dvec3(0, 0, -1) : glm::dvec3(1, 0, 0));
            EXPECT_EQ(light.corners.count, type.hasCorners() ? 3u : LightCorners().count);
        }
    }
}

TEST_F(LightTypes, everyTypeTakesKeyframesOfTheMembersThatItHas) {
    for (const LightTypeInfo& type : lightTypes())
        for (const LightKeyedInfo& member : keyedMembers()) {
            SCOPED_TRACE(fmt::format("{} {}", type.name, member.name));
            const std::string text = document(
                keysOf(type, 0.5f) + fmt::format(R"(, "keyframes": {{"{}": {{"times": [1], "values": [{}]}}}})",
                                                 member.name, member.width() == 1 ? "3" : "[0, 1, 0]"));
            const bool isTaken = member.member != LightKeyed::Position && member.isOf(type);
            EXPECT_EQ(test::schemaAccepts(text), isTaken);
            if (!isTaken) {
                EXPECT_NE(folder.errorOf(text), "");
                continue;
            }
            const LightKeys keys = folder.import(text).lights[0].keyframes.at(0);
            EXPECT_EQ(keys.of, member.member);
            EXPECT_EQ(keys.values.at(0), member.width() == 1 ? glm::dvec3(3, 0, 0) : glm::dvec3(0, 1, 0));
        }
}

TEST_F(LightTypes, aTypeNeverTakesWhatItsRowDoesNotGiveIt) {
    const auto isRefused = [&](const std::string& keys) { EXPECT_NE(folder.errorOf(document(keys)), ""); };
    for (const LightTypeInfo& type : lightTypes()) {
        const std::string keys = keysOf(type, 0.5f);
        LightTypeInfo bare = type;
        bare.parameters = {};
        if (!type.hasPosition()) isRefused(keys + R"(, "position": [1, 2, 3])");
        if (!type.hasPosition() || !type.hasDirection) isRefused(keys + R"(, "target": [1, 2, 4])");
        if (!type.hasDirection) isRefused(keys + R"(, "direction": [0, -1, 0])");
        for (const LightParameter& parameter : type.parameters)
            for (const float beyond : {parameter.least - 1.0f, parameter.most + 1.0f})
                isRefused(keysOf(bare, 0.0f) + fmt::format(R"(, "{}": {})", parameter.key, beyond));
        if (!type.isTurned()) isRefused(keys + R"(, "along": [1, 0, 0])");
        if (!type.hasCorners()) isRefused(keys + R"(, "corners": [[0, 0], [2, 0], [0.5, 0.25]])");
        if (!type.isFlat) isRefused(keys + R"(, "twoSided": false)");
        if (!type.isArea) isRefused(keys + R"(, "seen": true)");
        if (!type.isFlat) isRefused(keys + R"(, "texture": "a.png")");
        if (sizeParameter(type) == nullptr) isRefused(keys + R"(, "radius": 1)");
        for (const LightTypeInfo& other : lightTypes())
            if (other.type != type.type)
                for (const LightParameter& parameter : other.parameters)
                    if (keys.find(parameter.key) == std::string::npos)
                        isRefused(keys + fmt::format(R"(, "{}": {})", parameter.key, parameter.least));
    }
}

TEST_F(LightTypes, everyTypeIsAlwaysWrittenByItsKeysAndReadBackIdentically) {
    for (const LightTypeInfo& type : lightTypes()) {
        SCOPED_TRACE(type.name);
        Light light;
        light.name = "one";
        light.type = type.type;
        if (type.hasPosition()) light.positionWS = {1.0, 2.0, 3.0};
        if (type.hasDirection) light.directionWS = {0.0, -1.0, 0.0};
        for (const LightParameter& parameter : type.parameters)
            light.*parameter.member = parameter.kind == LightParameter::Kind::Angle ? glm::radians(30.0f) : 0.375f;
        if (const LightParameter* size = sizeParameter(type); size != nullptr && type.isArea)
            light.*size->member = 0.625f;
        if (type.isTurned()) light.alongWS = {0.6, 0.0, -0.8};
        if (type.hasCorners()) light.corners.metres[2] = {0.1f, 3.0f};
        light.isTwoSided = type.isFlat;
        light.isSeen = !type.isArea;
        const nlohmann::json written(write::lightJson(light));
        EXPECT_FALSE(written.contains("fields")) << written.dump();
        EXPECT_TRUE(scenejson::readLight(JsonValue(written, {}), 0) == light) << written.dump();
    }
}

TEST_F(LightTypes, aNumberOfALightOutsideTheBoundsOfItsRowIsAlwaysRefused) {
    Scene scene;
    scene.lights.emplace_back();
    EXPECT_NO_THROW(checkScene(scene));
    visitFields(kLightFields, [&](const auto& field) {
        if constexpr (std::is_same_v<decltype(field.member), float Light::*const>) {
            if (field.what == nullptr) return;
            const float above = field.most < kAnyNumber ? float(field.most) + 1.0f : kInfinity;
            for (const float beyond : {float(field.least) - 1.0f, above}) {
                Scene spoilt = scene;
                spoilt.lights[0].*field.member = beyond;
                EXPECT_ANY_THROW(checkScene(spoilt)) << field.name << " " << beyond;
            }
        }
    });
}

TEST_F(LightTypes, everyTypeAlwaysHasItsNumberAndItsFlagInShaders) {
    const frame::Defines defines = frame::featureDefines({});
    const auto valueOf = [&](const std::string& name) {
        for (const auto& [defined, value] : defines)
            if (defined == name) return value;
        return std::string("none");
    };
    for (const LightTypeInfo& type : lightTypes()) {
        std::string capitals(type.name);
        for (char& c : capitals) c = char(std::toupper(c));
        EXPECT_EQ(valueOf("LIGHT_" + capitals), fmt::format("{}", int(type.type)));
        EXPECT_EQ(valueOf("HAS_" + capitals + "_LIGHTS"), "0");
        frame::FeatureSet one;
        one.add(frame::featureOf(type.type));
        EXPECT_TRUE(one.anyLights());
        EXPECT_EQ(one.placedLights(), type.hasPosition());
        EXPECT_EQ(one.coneLights(), type.reach == LightReach::Cone);
        EXPECT_EQ(one.areaLights(), type.isArea);
        EXPECT_EQ(one.lightShapes(), type.hasShape());
    }
}

} // namespace
} // namespace tessera::scenes
