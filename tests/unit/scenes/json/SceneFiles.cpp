#include "tests/unit/scenes/json/SceneFiles.h"
#include "tests/support/UnderLedger.h"

namespace tessera::scenes::test {
namespace {

std::string withMembers(const std::string& members) {
    std::string text = R"({"tessera": 1, "include": [{"file": "models/bust.obj"}], )";
    return text.append(members).append("}");
}

} // namespace

SceneFolder::SceneFolder() {
    write("models/bust.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\no bust\nf 1/1 2/1 3/1\n");
    write("models/lamp.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no shade\nusemtl brass\nf 1 2 3\n");
    write("parts/lamps.json", R"({
        "tessera": 1,
        "name": "lamps",
        "include": [{"file": "../models/lamp.obj", "name": "lamp"}],
        "lights": [{"name": "bulb", "type": "spot", "position": [1, 2, 3], "direction": [1, 0, 0],
                    "falloff": {"type": "inverse_square", "range": 7}}],
        "cameras": [{"name": "from the lamp", "position": [1, 2, 3], "direction": [0, 0, -1]}],
        "environment": {"background": [9, 9, 9]},
        "options": {"technique": "forward"}
    })");
    write("hooks/redden.glsl", "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n");
    writePicture("pictures/albedo.tga", 1, 1, {{10, 20, 30, 255}});
    writePicture("pictures/specular.tga", 1, 1, {{40, 50, 60, 255}});
    writePicture("pictures/normal.tga", 1, 1, {{128, 128, 255, 255}});
}

Scene SceneFolder::import(std::string_view text) const {
    EXPECT_TRUE(schemaAccepts(text)) << text;
    Scene scene = underLedger(importSceneJson, write("scene.json", text));
    checkScene(scene);
    return scene;
}

Scene SceneFolder::importMembers(const std::string& members) const {
    return import(withMembers(members));
}

std::string SceneFolder::importError(std::string_view text) const {
    const std::filesystem::path file = write("scene.json", text);
    const std::string error = inputErrorOf([&] { underLedger(importSceneJson, file); });
    const std::string prefix = file.string() + ":";
    EXPECT_TRUE(error.starts_with(prefix)) << error;
    return error.substr(std::min(error.size(), prefix.size()));
}

std::string SceneFolder::errorOf(std::string_view text) const {
    EXPECT_FALSE(schemaAccepts(text)) << text;
    return importError(text);
}

std::string SceneFolder::errorOfMembers(const std::string& members) const {
    return errorOf(withMembers(members));
}

std::string SceneFolder::errorBeyondSchemaOf(std::string_view text) const {
    EXPECT_TRUE(schemaAccepts(text)) << text;
    return importError(text);
}

std::string SceneFolder::errorBeyondSchemaOfMembers(const std::string& members) const {
    return errorBeyondSchemaOf(withMembers(members));
}

} // namespace tessera::scenes::test
