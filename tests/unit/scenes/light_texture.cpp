// Images of lights: reading, sharing and writing.
#include "scenes/LightTexture.h"

#include <limits>

#include <fmt/format.h>

#include "scenes/Fingerprint.h"
#include "scenes/LoadLedger.h"
#include "scenes/import/Importers.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "scenes/write/SceneText.h"
#include "tests/support/LightPictures.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/PictureBytes.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

std::string glowLights(const std::string& lights) {
    return R"({"tessera": 1, "lights": [)" + lights + "]}";
}
const std::string kPanel =
    R"({"type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1], "texture": "glow.pfm"})";
const std::string kDisk =
    R"({"type": "disk", "position": [0, 0, 0], "direction": [0, 0, 1], "radius": 1, "texture": "glow.pfm"})";

TEST(LightTexture, lightsThatNameAFileShareItsPictureAndTheLedgerCountsItOnce) {
    const SceneFolder folder;
    folder.write("glow.pfm", pfmOf(2, 1, {0.5f, 2.0f, 0.0f, 0.25f, 3.0f, 0.125f}));
    const Scene scene = folder.import(glowLights(kPanel + "," + kDisk));
    ASSERT_EQ(scene.lights.size(), 2u);
    const LightTexture& texture = scene.lights[0].texture;
    ASSERT_TRUE(texture);
    EXPECT_EQ(&*texture, &*scene.lights[1].texture);
    EXPECT_EQ(texture->source, (folder.path() / "glow.pfm").string());
    EXPECT_EQ(texture->map.width, 2);
    EXPECT_EQ(texture.most(), glm::vec3(0.5f, 3.0f, 0.125f));
    Scene bare = scene, one = scene;
    for (Light& light : bare.lights) light.texture = {};
    one.lights[1].texture = {};
    EXPECT_EQ(bytesOf(scene), bytesOf(one));
    EXPECT_GE(bytesOf(one) - bytesOf(bare), 2 * sizeof(glm::vec4));
    EXPECT_NE(fingerprint(scene), fingerprint(bare));
    EXPECT_EQ(LightTexture().most(), glm::vec3(1.0f));
}

TEST(LightTexture, picturesStayChargedWhileALoadKeepsThemThoughABasesLightsAreReplaced) {
    constexpr int kSide = 512, kParts = 8; // 4 MiB each
    const SceneFolder folder;
    const std::string picture = pfmOf(kSide, kSide, std::vector<float>(3 * kSide * kSide, 1.0f));
    for (int i = 0; i < kParts; ++i) {
        folder.write(fmt::format("glow{}.pfm", i), picture);
        folder.write(fmt::format("base{}.json", i),
                     glowLights(fmt::format(R"({{"type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1],
                                                "texture": "glow{}.pfm"}})",
                                            i)));
        folder.write(fmt::format("part{}.json", i),
                     fmt::format(R"({{"tessera": 1, "base": {{"file": "base{}.json"}}, "lights": []}})", i));
    }
    const std::filesystem::path file =
        folder.write("parts.json", R"({"tessera": 1, "include": [)" + listOf(kParts, [](int i) {
                                       return fmt::format(R"({{"file": "part{}.json"}})", i);
                                   }) + "]}");
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file, 24 * kMiB); }), HasSubstr("of memory"));
    LoadLedger ledger(64 * kMiB);
    const Scene scene = importSceneJson(file, ledger);
    EXPECT_EQ(ledger.usedBytes(), bytesOf(scene)) << "which has none of them";
    EXPECT_LT(bytesOf(scene), kMiB);
}

TEST(LightTexture, numbersThatAreNoLightAreReplacedAndReported) {
    const SceneFolder folder;
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    folder.write("glow.pfm", pfmOf(2, 1, {nan, -1.0f, 3.0f, infinite, 0.5f, 0.0f}));
    const Scene scene = folder.import(glowLights(kPanel));
    EXPECT_EQ(scene.lights[0].texture.most(), glm::vec3(3.0f, 0.5f, 3.0f));
    EXPECT_THAT(scene.warnings,
                ElementsAre("the texture 'glow.pfm' of a light holds NaN in 1 number, taken as 0",
                            "the texture 'glow.pfm' of a light is below 0 in 1 number, taken as 0",
                            "the texture 'glow.pfm' of a light holds infinity in 1 number, taken as its brightest"));
}

TEST(LightTexture, roundShapesAndMissingFilesAreRefusedByName) {
    const SceneFolder folder;
    EXPECT_THAT(
        folder.errorOf(glowLights(R"({"type": "sphere", "position": [0, 0, 0], "radius": 1, "texture": "glow.pfm"})")),
        HasSubstr("/lights/0/texture: a sphere light has no texture"));
    EXPECT_THAT(folder.errorOf(glowLights(R"({"type": "tube", "position": [0, 0, 0], "direction": [0, 0, 1],
                                              "radius": 1, "texture": "glow.pfm"})")),
                HasSubstr("a tube light has no texture"));
    EXPECT_THAT(folder.errorBeyondSchemaOf(glowLights(kPanel)), HasSubstr("/lights/0/texture: there is no file"));
    EXPECT_THAT(folder.errorOf(glowLights(R"({"type": "point", "position": [0, 0, 0], "texture": "glow.pfm"})")),
                HasSubstr("a point light has no key 'texture'"));
}

TEST(LightTexture, isWrittenByItsNameAndReadBackIdentically) {
    for (const LightTypeInfo& type : lightTypes()) {
        SCOPED_TRACE(type.name);
        Light light;
        light.name = "glow";
        light.type = type.type;
        light.texture = tessera::test::evenLightTexture(glm::vec3(0.5f));
        const nlohmann::json written(write::lightJson(light, "../glow.pfm"));
        EXPECT_EQ(written.contains("texture"), type.isFlat) << written.dump();
        const Light back = scenejson::readLight(JsonValue(written, {}), 0, [&](const JsonValue& name) {
            EXPECT_EQ(name.text(), "../glow.pfm");
            return light.texture;
        });
        if (!type.isFlat) light.texture = {};
        EXPECT_TRUE(back == light) << written.dump();
    }
}

TEST(LightTexture, aPictureThatLacksTexelsIsRefused) {
    Scene scene;
    scene.lights.emplace_back();
    scene.lights[0].type = LightType::Rectangle;
    scene.lights[0].texture = tessera::test::evenLightTexture(glm::vec3(1.0f));
    EXPECT_NO_THROW(checkScene(scene));
    LightPicture lacking = *scene.lights[0].texture;
    lacking.map.width += 1;
    scene.lights[0].texture = LightTexture(lacking);
    EXPECT_ANY_THROW(checkScene(scene));
}

} // namespace
} // namespace tessera::scenes
