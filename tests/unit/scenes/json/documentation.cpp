#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "scenes/Limits.h"
#include "scenes/Load.h"
#include "scenes/Schema.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using SceneFormat = SceneFiles;

std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

const std::filesystem::path kRepository = TESSERA_SOURCE_DIR;

TEST_F(SceneFormat, theEmbeddedSchemaIsExactlyTheShippedFile) {
    EXPECT_EQ(sceneSchema(), textOf(kRepository / "scenes" / "schema" / "scene.schema.json"));
}

TEST_F(SceneFormat, theSchemaTakesAsManyLightsOfABuiltinSceneAsCanBeDrawn) {
    const auto based = [](int lights) {
        return fmt::format(R"({{"tessera": 1, "base": {{"file": "builtin:lattice", "lights": {}}}}})", lights);
    };
    EXPECT_TRUE(schemaAccepts(based(kMostLights)));
    EXPECT_FALSE(schemaAccepts(based(kMostLights + 1)));
}

TEST_F(SceneFormat, everyDocumentedExampleLoads) {
    const std::string text = textOf(kRepository / "docs" / "scene-format.md");
    constexpr std::string_view kOpening = "```json\n";
    int examples = 0;
    for (std::size_t at = text.find(kOpening); at != std::string::npos; at = text.find(kOpening, at)) {
        at += kOpening.size();
        const std::size_t end = text.find("```", at);
        ASSERT_NE(end, std::string::npos);
        EXPECT_NO_THROW(folder.import(text.substr(at, end - at))) << text.substr(at, end - at);
        ++examples;
        at = end;
    }
    EXPECT_GE(examples, 5);
}

TEST_F(SceneFormat, theSchemaTakesEveryModelWithTheParametersOfItsRowAlsoInOverrides) {
    const auto valueOf = [](const MaterialParameter& parameter) {
        using enum MaterialParameter::Kind;
        return parameter.kind == Color ? "[0.5, 0.5, 0.5]" : parameter.kind == Masking ? R"("walter")" : "1";
    };
    for (const MaterialModelInfo& model : materialModels()) {
        SCOPED_TRACE(model.name);
        std::string keys = fmt::format(R"("model": "{}", "{}": [0.5, 0.5, 0.5])", model.name, model.colorKey);
        for (const MaterialParameter& parameter : model.parameters)
            keys += fmt::format(R"(, "{}": {})", parameter.key, valueOf(parameter));
        const std::string owned = R"({"tessera": 1, "materials": [{"name": "m", )" + keys + "}]}";
        EXPECT_TRUE(schemaAccepts(owned)) << owned;
        EXPECT_EQ(folder.import(owned).materials[0].model, model.model);
        const std::string overridden = R"({"tessera": 1, "overrides": [{"material": "m", )" + keys + "}]}";
        EXPECT_TRUE(schemaAccepts(overridden)) << overridden;
    }
}

TEST_F(SceneFormat, everyShippedScenePassesTheSchema) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kRepository / "scenes" / "files")) {
        if (entry.path().extension() != ".json") continue;
        EXPECT_TRUE(schemaAccepts(textOf(entry.path()))) << entry.path();
        ++scenes;
    }
    EXPECT_GE(scenes, 1);
}

} // namespace
} // namespace tessera::scenes
