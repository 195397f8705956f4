#include <limits>

#include <fmt/format.h>

#include "tests/cli/program/Cli.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"

namespace tessera::test {
namespace {

using scenes::gltf::test::Builder;
using scenes::gltf::test::Json;

class BadScenes : public Cli {
protected:
    void SetUp() override { folder_.write("a.png", "an older picture"); }

    void expectRefused(const std::string& file, const Words& parts) const {
        Words all = parts;
        all.push_back(file);
        expectError(kBadInput, {"render", file, "-o", "a.png"}, all);
    }
    void expectRefused(const Builder& builder, const Words& parts) const {
        folder_.write("m.gltf", builder.json.dump());
        expectRefused("m.gltf", parts);
    }
    void expectSceneRefused(const std::string& text, const std::string& place) const {
        folder_.write("s.json", text);
        expectRefused("s.json", {"s.json:" + place});
    }
};

TEST_F(BadScenes, missingEmptyAndFarAwayFilesAreRefused) {
    for (const char* name : {"m.gltf", "m.glb", "m.obj", "m.json"}) {
        expectRefused(name, {"no such file"});
        folder_.write(name, "");
        expectRefused(name, {"empty"});
    }
    folder_.write("far.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n");
    expectRefused("far.obj", {"far.obj:2: the position lies more than 1e+15 m away"});
    folder_.write("m.txt", "text");
    expectRefused("m.txt", {"not a scene file", ".gltf, .glb, .obj or .json"});
    expectError(kBadInput, {"render", ".", "-o", "a.png"}, {".: is a folder; give"});
}

TEST_F(BadScenes, truncatedGlbIsRefused) {
    std::string text = Builder().json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        std::string bytes;
        for (int shift = 0; shift < 32; shift += 8) bytes += char(value >> shift & 0xff);
        return bytes;
    };
    const std::string whole = "glTF" + word(2) + word(20 + text.size()) + word(text.size()) + "JSON" + text;
    folder_.write("m.glb", whole);
    EXPECT_EQ(run({"render", "m.glb", "--size", "16x9", "-o", "b.png"}).exitCode, 0);
    for (const std::size_t length :
         {std::size_t(1), std::size_t(11), std::size_t(19), whole.size() / 2, whole.size() - 1}) {
        folder_.write("m.glb", whole.substr(0, length));
        expectRefused("m.glb", {});
    }
}

TEST_F(BadScenes, gltfDataOutOfRangeIsRefusedByName) {
    Builder accessor;
    accessor.json["accessors"][0]["count"] = 300;
    expectRefused(accessor, {"/accessors/0", "past the end"});
    Builder index;
    index.indices({0, 1, 3});
    expectRefused(index, {"/meshes/0/primitives/0", "index 3", "there are 3"});
    Builder positions;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    positions.attribute("POSITION", "VEC3", {0, 0, 0, 1, nan, 0, 0, 1, 0});
    expectRefused(positions, {"/meshes/0/primitives/0", "vertex 1", "not finite"});
    Builder texture;
    texture.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
    texture.json["textures"] = Json::parse(R"([{"source": 0}])");
    texture.json["images"] = Json::parse(R"([{"uri": "nix.png"}])");
    texture.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, 0, 0, 1});
    folder_.write("m.gltf", texture.json.dump());
    expectError(kBadInput, {"render", "m.gltf", "--strict", "-o", "a.png"}, {"m.gltf: /images/0: ", "nix.png"});
    Builder cycle;
    cycle.json["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])");
    folder_.write("m.gltf", cycle.json.dump());
    expectError(kBadInput, {"render", "m.gltf", "--strict", "-o", "a.png"}, {"m.gltf: /nodes/0: has several parents"});
    Builder extension;
    extension.json["extensionsRequired"] = {"EXT_some_compression"};
    expectRefused(extension, {"EXT_some_compression"});
}

TEST_F(BadScenes, filesThatAreNoGltfAreRefused) {
    for (const char* text : {"{", "[]", "{\"asset\": 1}", "glTF"}) {
        folder_.write("m.gltf", text);
        expectRefused("m.gltf", {});
        folder_.write("m.glb", text);
        expectRefused("m.glb", {});
    }
}

TEST_F(BadScenes, brokenObjIsRefusedByLine) {
    folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    expectRefused("m.obj", {"4"});
    folder_.write("m.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    expectRefused("m.obj", {"2"});
}

TEST_F(BadScenes, mistakesInASceneFileAreNamedByFileAndPointer) {
    expectSceneRefused("{\"tessera\": 1,}", "1:");
    expectSceneRefused(R"({"tessera": 2})", "/tessera: ");
    expectSceneRefused(R"({"tessera": 1, "lihgts": []})", "/: ");
    expectSceneRefused(R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0]}]})", "/lights/0/position: ");
    expectSceneRefused(R"({"tessera": 1, "lights": [{"type": "point", "position": [0, 0, 0], "intensty": 1}]})",
                       "/lights/0: ");
    expectSceneRefused(R"({"tessera": 1, "include": [{"file": "nix.obj"}]})", "/include/0/file: ");
    expectSceneRefused(R"({"tessera": 1, "include": [{"file": "s.json"}]})", "/include/0/file: ");
    expectSceneRefused(R"({"tessera": 1, "overrides": [{"node": "nix", "material": "m"}]})", "/overrides/0/");
    expectSceneRefused(R"({"tessera": 1, "options": {"technique": "defered"}})", "/options/technique: ");
    expectSceneRefused(R"({"tessera": 1, "options": {"layout": "pakced"}})", "/options/layout: ");
    expectSceneRefused(R"({"tessera": 1, "options": {"toneMap": "acess"}})", "/options/toneMap: ");
    expectSceneRefused(R"({"tessera": 1, "options": {"camera": "nix"}})", "/options/camera: ");
    expectSceneRefused(R"({"tessera": 1, "options": {"size": [0, 9]}})", "/options/size");
}

TEST_F(BadScenes, aBrokenPngIsOneLine) {
    ASSERT_EQ(run({"render", "room", "--size", "32x18", "-o", "whole.png"}).exitCode, 0);
    const std::string whole = text("whole.png");
    folder_.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    folder_.write("m.mtl", "newmtl m\nmap_Kd b.png\n");
    for (const std::size_t harmed : {std::size_t(20), std::size_t(30), whole.size() / 2, whole.size() - 30}) {
        std::string bytes = whole;
        bytes[harmed] = char(bytes[harmed] ^ 0x55);
        folder_.write("b.png", bytes);
        expectError(kBadInput, {"render", "m.obj", "--strict", "-o", "a.png"}, {"m.mtl", "b.png", "broken"});
    }
}

} // namespace
} // namespace tessera::test
