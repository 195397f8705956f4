#include <algorithm>

#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class SceneJson : public SceneFiles {
protected:
    std::string syntaxErrorOf(std::string_view text) const {
        const std::filesystem::path file = folder.write("scene.json", text);
        const std::string error = inputErrorOf([&] { underLedger(importSceneJson, file); });
        return error.substr(std::min(error.size(), file.string().size() + 1));
    }
};

TEST_F(SceneJson, brokenSyntaxIsPlacedByLineAndColumn) {
    for (const auto& [text, error] :
         {std::pair("{\n  \"tessera\": 1,\n  \"name\" 3\n}",
                    "3:10: syntax error while parsing object separator - unexpected number literal; expected ':'"),
          {R"({"tessera": NaN})",
           "1:13: syntax error while parsing value - invalid literal; last read: '\"tessera\": N'"},
          {R"({"tessera": 1,})",
           "1:15: syntax error while parsing object key - unexpected '}'; expected string literal"},
          {"{\"tessera\": 1,\n \"environment\": {\"background\": [1e999, 0, 0]}}",
           "2:37: number overflow parsing '1e999'"},
          {R"({"tessera": 1, "tessera": 1})", "/: the key 'tessera' is given twice; keep one"},
          {R"({"lights": [{"a": {}}, {"b/c": {"x": 1, "y": [{"x": 0}], "x": 2}}]})",
           "/lights/1/b~1c: the key 'x' is given twice; keep one"},
          {"", " the file is empty; start with {\"tessera\": 1}"}})
        EXPECT_EQ(syntaxErrorOf(text), error);
    EXPECT_THAT(syntaxErrorOf("{\"tessera\": 1\n"), StartsWith("2:1: "));
}

TEST_F(SceneJson, aMissingFileIsNamed) {
    EXPECT_EQ(inputErrorOf([] { underLedger(importSceneJson, "no/such.json"); }),
              "no/such.json: there is no such file; check the name and the folder");
}

TEST_F(SceneJson, theSmallestSceneHasTheFilesName) {
    EXPECT_EQ(folder.import(R"({"tessera": 1})").name, "scene");
    EXPECT_EQ(folder.import(R"({"tessera": 1, "name": "hall", "$schema": "scene.schema.json"})").name, "hall");
}

TEST_F(SceneJson, whatNoSceneHasIsRefused) {
    const std::string point = R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], )";
    for (const auto& [text, error] :
         {std::pair<std::string, std::string>("{}", "/: lacks the key 'tessera'; add it"),
          {R"({"tessera": 2})", "/tessera: must be 1, the version of the format that this program reads"},
          {"[1]", "/: is an array; an object is needed"},
          {R"({"tessera": 1, "lihgts": []})", "/: a scene has no key 'lihgts'; did you mean 'lights'?"},
          {point + R"("intensty": 2}]})", "/lights/0: a point light has no key 'intensty'; did you mean 'intensity'?"},
          {point + R"("target": [1, 0, 0]}]})",
           "/lights/0: a point light has no key 'target'; valid are type, name, enabled, color, intensity, flicker, "
           "keyframes, position, falloff, animation, castsShadow, radius, fields"},
          {R"({"tessera": 1, "lights": {}})", "/lights: is an object; an array is needed"},
          {R"({"tessera": 1, "name": 3})", "/name: is a number; text is needed"},
          {R"({"tessera": 1, "name": ""})", "/name: is empty; give a name"},
          {R"({"tessera": 1, "environment": {"background": "red"}})",
           "/environment/background: is text; an array of 3 is needed"},
          {R"({"tessera": 1, "environment": {"background": [1, null, 0]}})",
           "/environment/background/1: is null; a number is needed"}})
        EXPECT_EQ(folder.errorOf(text), error);
}

} // namespace
} // namespace tessera::scenes
