#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using test::SceneFolder;

std::string syntaxErrorOf(std::string_view text) {
    const test::TempFolder folder;
    const std::filesystem::path file = folder.write("scene.json", text);
    const std::string error = test::inputErrorOf([&] { underLedger(importSceneJson, file); });
    return error.substr(std::min(error.size(), file.string().size() + 1));
}

TEST(SceneJson, brokenSyntaxIsPlacedByLineAndColumn) {
    EXPECT_EQ(syntaxErrorOf("{\n  \"tessera\": 1,\n  \"name\" 3\n}"),
              "3:10: syntax error while parsing object separator - unexpected number literal; expected ':'");
    EXPECT_EQ(syntaxErrorOf("{\"tessera\": NaN}"),
              "1:13: syntax error while parsing value - invalid literal; last read: '\"tessera\": N'");
    EXPECT_EQ(syntaxErrorOf("{\"tessera\": 1,}"),
              "1:15: syntax error while parsing object key - unexpected '}'; expected string literal");
    EXPECT_TRUE(syntaxErrorOf("{\"tessera\": 1\n").starts_with("2:1: ")) << syntaxErrorOf("{\"tessera\": 1\n");
}

TEST(SceneJson, aNumberTooLargeForADoubleIsRefused) {
    EXPECT_EQ(syntaxErrorOf("{\"tessera\": 1,\n \"environment\": {\"background\": [1e999, 0, 0]}}"),
              "2:37: number overflow parsing '1e999'");
}

TEST(SceneJson, aRepeatedKeyIsRefused) {
    EXPECT_EQ(syntaxErrorOf("{\"tessera\": 1, \"tessera\": 1}"), "/: the key 'tessera' is given twice; keep one");
    EXPECT_EQ(syntaxErrorOf("{\"lights\": [{\"a\": {}}, {\"b/c\": {\"x\": 1, \"y\": [{\"x\": 0}], \"x\": 2}}]}"),
              "/lights/1/b~1c: the key 'x' is given twice; keep one");
}

TEST(SceneJson, anEmptyFileIsRefused) {
    EXPECT_EQ(syntaxErrorOf(""), " the file is empty; start with {\"tessera\": 1}");
}

TEST(SceneJson, aMissingFileIsNamed) {
    EXPECT_EQ(test::inputErrorOf([] { underLedger(importSceneJson, "no/such.json"); }),
              "no/such.json: there is no such file; check the name and the folder");
}

TEST(SceneJson, theSmallestSceneHasTheFilesName) {
    const SceneFolder folder;
    EXPECT_EQ(folder.import(R"({"tessera": 1})").name, "scene");
    EXPECT_EQ(folder.import(R"({"tessera": 1, "name": "hall", "$schema": "scene.schema.json"})").name, "hall");
}

TEST(SceneJson, theVersionIsChecked) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorOf("{}"), "/: lacks the key 'tessera'; add it");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 2})"),
              "/tessera: must be 1, the version of the format that this program reads");
    EXPECT_EQ(folder.errorOf("[1]"), "/: is an array; an object is needed");
}

TEST(SceneJson, anUnknownKeyIsRefusedWithTheNearest) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "lihgts": []})"),
              "/: a scene has no key 'lihgts'; did you mean 'lights'?");
    EXPECT_EQ(folder.errorOfMembers(R"("lights": [{"type": "point", "position": [0, 0, 0], "intensty": 2}])"),
              "/lights/0: a point light has no key 'intensty'; did you mean 'intensity'?");
    EXPECT_EQ(folder.errorOfMembers(R"("lights": [{"type": "point", "position": [0, 0, 0], "target": [1, 0, 0]}])"),
              "/lights/0: a point light has no key 'target'; valid are type, name, enabled, color, intensity, flicker, "
              "keyframes, position, falloff, animation, castsShadow, radius, fields");
}

TEST(SceneJson, aWrongTypeIsRefused) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "lights": {}})"), "/lights: is an object; an array is needed");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "name": 3})"), "/name: is a number; text is needed");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "name": ""})"), "/name: is empty; give a name");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "environment": {"background": "red"}})"),
              "/environment/background: is text; an array of 3 is needed");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "environment": {"background": [1, null, 0]}})"),
              "/environment/background/1: is null; a number is needed");
}

} // namespace
} // namespace tessera::scenes
