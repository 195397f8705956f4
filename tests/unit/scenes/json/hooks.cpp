#include "base/Error.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

class HookFiles : public SceneFiles {
protected:
    static constexpr std::string_view kText = "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n";

    HookFiles() { folder.write("hooks/tint.glsl", kText); }
    static std::string members(const std::string& more) {
        return R"("materials": [{"name": "a", "model": "lambert", "k_d": [1, 1, 1]},
                                {"name": "b", "model": "lambert", "k_d": [1, 1, 1]}],
                  "overrides": [{"node": "bust", "material": "b"}],
                  "hook": {"file": "hooks/tint.glsl")" +
               more + "}";
    }
    /// Returns the error of a hook with these members.
    std::string errorWith(const std::string& more) const { return folder.errorBeyondSchemaOfMembers(members(more)); }
};

TEST_F(HookFiles, aHookHasItsFileMaterialsAndParameters) {
    const Scene scene = folder.importMembers(
        members(R"(, "materials": ["b"], "parameters": [{"name": "speed", "value": 2, "least": -1, "most": 4},
                                                        {"name": "share", "value": 0.5}])"));
    ASSERT_TRUE(scene.hook.has_value());
    EXPECT_EQ(scene.hook->file, (folder.path() / "hooks/tint.glsl").string());
    ASSERT_EQ(scene.hook->materials.size(), 1u);
    EXPECT_EQ(scene.materials[std::size_t(scene.hook->materials[0])].name, "b");
    EXPECT_THAT(scene.hook->parameters,
                ElementsAre(HookParameter{"speed", 2.0f, -1.0f, 4.0f}, HookParameter{"share", 0.5f, 0.0f, 1.0f}));
    EXPECT_EQ(folder.importMembers(members("")).hook->materials.size(),
              folder.importMembers(members("")).materials.size());
}

TEST_F(HookFiles, anotherTextIsAnotherHook) {
    const std::uint64_t before = folder.importMembers(members("")).hook->contentHash;
    EXPECT_EQ(folder.importMembers(members("")).hook->contentHash, before);
    folder.write("hooks/tint.glsl", std::string(kText) + "\n");
    EXPECT_NE(folder.importMembers(members("")).hook->contentHash, before);
}

TEST_F(HookFiles, faultsNameTheirPlace) {
    EXPECT_THAT(errorWith(R"(, "materials": ["c"])"), HasSubstr("/hook/materials/0: there is no material 'c'"));
    EXPECT_THAT(errorWith(R"(, "materials": ["b", "b"])"), HasSubstr("/hook/materials/1: 'b' is in the list already"));
    EXPECT_THAT(errorWith(R"(, "parameters": [{"name": "a", "value": 3}])"),
                HasSubstr("/hook/parameters/0/value: is 3, and must lie between its least, 0, and its most, 1"));
    EXPECT_THAT(errorWith(R"(, "parameters": [{"name": "a", "value": 0}, {"name": "a", "value": 1}])"),
                HasSubstr("/hook/parameters/1: the name 'a' is taken"));
    EXPECT_THAT(folder.errorOfMembers(members(R"(, "parameters": [{"name": "timeSeconds", "value": 0}])")),
                HasSubstr("/hook/parameters/0/name: must be a letter"));
    EXPECT_THAT(folder.errorOfMembers(members(R"(, "sped": 3)")), HasSubstr("/hook"));
    EXPECT_THAT(folder.errorBeyondSchemaOfMembers(R"("hook": {"file": "hooks/gone.glsl"})"),
                HasSubstr("/hook/file: there is no file"));
}

TEST_F(HookFiles, anEditedSceneGivesTheHookOfItsBaseOtherValues) {
    folder.write("base.json", R"({"tessera": 1, "include": [{"file": "models/bust.obj"}],
        "hook": {"file": "hooks/tint.glsl", "parameters": [{"name": "a", "value": 0.25}, {"name": "b", "value": 1}]}})");
    const auto edited = [](const std::string& hook) {
        return R"({"tessera": 1, "base": {"file": "base.json"}, "hook": )" + hook + "}";
    };
    const Scene scene = folder.import(edited(R"({"values": {"a": 0.75}})"));
    ASSERT_TRUE(scene.hook.has_value());
    EXPECT_THAT(scene.hook->parameters, ElementsAre(HookParameter{"a", 0.75f}, HookParameter{"b", 1.0f}));
    EXPECT_FALSE(folder.import(edited("null")).hook.has_value());
    EXPECT_THAT(folder.errorBeyondSchemaOf(edited(R"({"values": {"a": 2}})")), HasSubstr("/hook/values/a: is 2"));
    EXPECT_THAT(folder.errorBeyondSchemaOf(edited(R"({"values": {"c": 1}})")), HasSubstr("/hook/values"));
    EXPECT_THAT(folder.errorOf(edited(R"({"values": {"a": 1}, "file": "hooks/tint.glsl"})")), HasSubstr("/hook"));
    EXPECT_THAT(folder.errorBeyondSchemaOf(R"({"tessera": 1, "hook": {"values": {"a": 1}}})"),
                HasSubstr("/hook/values: there is no hook of a base"));
}

TEST_F(HookFiles, whatMovesVerticesSaysHowFar) {
    folder.write("hooks/tint.glsl", "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) {}\n");
    const Scene scene = folder.importMembers(members(R"(, "mayMoveMetres": 0.25)"));
    EXPECT_TRUE(scene.hook->movesVertices);
    EXPECT_FALSE(scene.hook->changesSurfaces);
    EXPECT_EQ(scene.hook->mayMoveMetres, 0.25);
    EXPECT_THAT(errorWith(""), HasSubstr("/hook: lacks 'mayMoveMetres'"));
    EXPECT_THAT(folder.errorOfMembers(members(R"(, "mayMoveMetres": -1)")), HasSubstr("/hook/mayMoveMetres: is -1"));
    folder.write("hooks/tint.glsl", kText);
    EXPECT_THAT(errorWith(R"(, "mayMoveMetres": 0.25)"), HasSubstr("/hook/mayMoveMetres: the file has no hookVertex"));
}

TEST_F(HookFiles, aMeshOfWhichOnlySomeInstancesMoveIsRefused) {
    folder.write("hooks/tint.glsl", "void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) {}\n");
    Scene scene = folder.importMembers(members(R"(, "mayMoveMetres": 0.25, "materials": ["b"])"));
    Node& node = scene.nodes.emplace_back();
    node.instances = {{0, scene.hook->materials[0]}};
    checkScene(scene);
    scene.materials.emplace_back().name = "other";
    node.instances[0].material = int(scene.materials.size()) - 1;
    EXPECT_THAT(inputErrorOf([&] { checkScene(scene); }), HasSubstr("cannot be in two places"));
}

TEST_F(HookFiles, aFaultOfTheFileNamesItsLine) {
    const std::filesystem::path file = folder.write("hooks/tint.glsl", std::string(kText) + "\nuniform float x;\n");
    const std::filesystem::path scene =
        folder.write("scene.json", R"({"tessera": 1, "hook": {"file": "hooks/tint.glsl"}})");
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, scene); }),
                HasSubstr(file.string() + ":3: uniform: a hook binds nothing"));
}

TEST_F(HookFiles, anIncludeKeepsItsHookAndASecondOneIsRefused) {
    folder.write("parts/tinted.json", R"({"tessera": 1, "include": [{"file": "../models/bust.obj"}],
        "materials": [{"name": "skin", "model": "lambert", "k_d": [1, 1, 1]}],
        "overrides": [{"node": "bust", "material": "skin"}],
        "hook": {"file": "../hooks/tint.glsl", "materials": ["skin"]}})");
    const std::string once =
        R"({"tessera": 1, "include": [{"file": "models/bust.obj"}, {"file": "parts/tinted.json"}])";
    const Scene scene = folder.import(once + "}");
    ASSERT_TRUE(scene.hook.has_value());
    ASSERT_EQ(scene.hook->materials.size(), 1u);
    EXPECT_EQ(scene.materials[std::size_t(scene.hook->materials[0])].name, "skin");
    EXPECT_FALSE(folder.import(once + R"(, "hook": null})").hook.has_value());
    EXPECT_THAT(folder.errorBeyondSchemaOf(
                    R"({"tessera": 1, "include": [{"file": "parts/tinted.json"}, {"file": "parts/tinted.json"}]})"),
                HasSubstr("/include/1: it has a hook"));
}

} // namespace
} // namespace tessera::scenes
