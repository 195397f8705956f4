#include <chrono>
#include <cmath>

#include "scenes/import/JsonReader.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"

/// Scenes imported from flawed files. Tests of each kind of content cover their warnings and strict refusals.
namespace tessera::scenes::gltf::test {
namespace {

struct Repaired {
    const char* pointer;
    const char* value;
    const char* warning; ///< part of the only warning; null for none
    std::function<bool(const Scene&)> isRight;
};

const Material& paintOf(const Scene& scene) {
    return scene.materials.at(std::size_t(scene.nodes.at(0).instances.at(0).material));
}

std::function<bool(const Scene&)> has(auto Material::*member, auto value) {
    return [=](const Scene& scene) { return paintOf(scene).*member == value; };
}

const Repaired kRepaired[] = {
    {"/materials/0/pbrMetallicRoughness", R"({"roughnessFactor": 1.5})",
     "is 1.5; it must be at most 1; the nearest bound", has(&Material::perceptualRoughness, 1.0f)},
    {"/materials/0/pbrMetallicRoughness", R"({"roughnessFactor": null, "metallicFactor": -1})",
     "but is null; it is left out", has(&Material::metallic, 0.0f)},
    {"/materials/0/pbrMetallicRoughness", R"({"baseColorFactor": [0.5, 0.25, 0]})", "its alpha is 1",
     has(&Material::baseColor, glm::vec4(0.5f, 0.25f, 0.0f, 1.0f))},
    {"/materials/0/emissiveFactor", "[1, 2, 3, 4]", "the numbers beyond are left out",
     has(&Material::emissive, glm::vec3(1.0f, 2.0f, 3.0f))},
    {"/materials/0/doubleSided", "1", "1 is taken as true", has(&Material::doubleSided, true)},
    {"/materials/0/alphaMode", R"("CUTOUT")", "it is left out", has(&Material::alphaMode, AlphaMode::Opaque)},
    {"/materials/0/extensions/KHR_materials_ior", R"({"ior": 0.47})", "1 is taken", has(&Material::ior, 1.0f)},
    {"/materials/0/extensions/KHR_materials_volume", R"({"attenuationDistance": 0})",
     "more than 0 is needed; it is left out",
     has(&Material::attenuationDistanceMetres, Material().attenuationDistanceMetres)},
    {"/materials/0/name", "7", nullptr, has(&Material::name, std::string("material 0"))},
    {"/buffers/0/byteLength", "null", "all of its data is read",
     [](const Scene& scene) { return scene.meshes.size() == 1; }},
    {"/materials/1", R"({"alphaMode": "CUTOUT"})", nullptr, has(&Material::name, std::string("paint"))},
    {"/meshes/1", "{}", nullptr, [](const Scene& scene) { return scene.meshes.size() == 1; }},
    {"/nodes/0/camera", "-1", "it is left out", [](const Scene& scene) { return scene.meshes.size() == 1; }},
    {"/nodes/0/matrix", "[1,0,0,0, 0,1,0,0, 0,0,1,0, 4,0,0,2]", "it is divided by its last number",
     [](const Scene& scene) { return scene.nodes[0].parentFromNode[3] == glm::dvec4(2.0, 0.0, 0.0, 1.0); }},
    {"/nodes/0/rotation", "[0, 0, 0, 0]", "nothing is rotated",
     [](const Scene& scene) { return scene.nodes[0].parentFromNode == glm::dmat4(1.0); }},
    {"/nodes/0/scale", "[2, null, 2]", "it is left out",
     [](const Scene& scene) { return scene.nodes[0].parentFromNode == glm::dmat4(1.0); }},
};

TEST(GltfRepairs, drawWhatTheSceneNeeds) {
    for (const Repaired& row : kRepaired) {
        Builder builder;
        builder.material();
        builder.json[Json::json_pointer(row.pointer)] = Json::parse(row.value);
        SCOPED_TRACE(row.pointer);
        const Scene scene = builder.import();
        EXPECT_TRUE(row.isRight(scene)) << row.value;
        if (row.warning == nullptr)
            EXPECT_THAT(scene.warnings, IsEmpty());
        else
            EXPECT_TRUE(hasWarning(scene, row.warning)) << row.value << testing::PrintToString(scene.warnings);
    }
}

TEST(GltfRepairs, whatCannotBeReadTakesOnlyItsOwnPrimitiveAlong) {
    Builder builder;
    const int empty = builder.add("VEC3", {0, 0, 0});
    builder.json["accessors"].back()["count"] = 0;
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", empty}}}});
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", empty}});
    const Scene scene = builder.import();
    EXPECT_THAT(scene.nodes.at(0).instances, SizeIs(1));
    EXPECT_TRUE(hasWarning(scene, "/accessors/1/count: is 0; it must be at least 1; it is left out (and 1 more)"));
}

TEST(GltfRepairs, anAttributeThatCannotBeReadIsLeftOutAlone) {
    Builder builder;
    builder.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, 1});
    builder.attribute("COLOR_0", "VEC3", {1, 1, 1, 0, 0, 0, NAN, 0, 0});
    const Mesh mesh = builder.import().meshes.at(0);
    EXPECT_THAT(mesh.positionsOS, SizeIs(3));
    EXPECT_THAT(mesh.texCoords[0], IsEmpty());
    EXPECT_THAT(mesh.colors, IsEmpty());
}

/// Two triangles, one of which refers to a missing vertex, or to one without a finite position or too far.
TEST(GltfRepairs, trianglesWithLostCornersAreLeftOut) {
    for (const std::uint16_t lost : {std::uint16_t{5}, std::uint16_t{3}, std::uint16_t{4}, std::uint16_t{0xffff}}) {
        Builder builder;
        builder.attribute("POSITION", "VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, INFINITY, 0, 0, 0, 0, 1.1e15f});
        builder.indices<std::uint16_t>({0, 1, lost, 0, 1, 2});
        const Scene scene = builder.import();
        EXPECT_THAT(scene.meshes.at(0).indices, SizeIs(3)) << lost;
        EXPECT_TRUE(hasWarning(scene, "what it would be a corner of is left out"));
    }
}

/// Two primitives of one material, the second with texture coordinates.
TEST(GltfRepairs, whereTextureCoordinatesAreMissingColoursAreTheStandIn) {
    Builder builder =
        withMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}})");
    builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    builder.primitive()["attributes"] = {{"POSITION", 0}};
    const Scene scene = builder.import();
    const auto materialOf = [&](std::size_t instance) {
        return scene.materials.at(std::size_t(scene.nodes.at(0).instances.at(instance).material));
    };
    const auto picture = [&](std::size_t instance, TextureSlot slot) {
        return materialOf(instance).texture(slot).image;
    };
    EXPECT_NE(picture(0, TextureSlot::BaseColor), picture(1, TextureSlot::BaseColor));
    EXPECT_EQ(materialOf(0).name, "paint, without texture coordinates");
    EXPECT_EQ(picture(0, TextureSlot::Normal), kNone);
    EXPECT_NE(picture(1, TextureSlot::Normal), kNone);
    const int set = materialOf(0).texture(TextureSlot::BaseColor).texCoordSet;
    EXPECT_EQ(scene.meshes.at(0).texCoords.at(std::size_t(set)), (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_TRUE(
        hasWarning(scene, "/materials/0/pbrMetallicRoughness/baseColorTexture: needs TEXCOORD_0, which a mesh lacks"));
}

TEST(GltfRepairs, aNodeTooFarIsHiddenAlone) {
    Builder builder;
    builder.merge(R"({"scenes": [{"nodes": [0, 1]}],
                      "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0, 1e20, 0]}]})");
    const Scene scene = builder.import();
    checkScene(scene);
    EXPECT_TRUE(hasWarning(scene, "/nodes/1: its transform, with its ancestors', is not finite or leads more than "
                                  "1e+15 m away; it is hidden with all below it"));
    EXPECT_THAT(scene.nodes.at(0).instances, SizeIs(1));
}

TEST(GltfRepairs, urisAreReadInAnySpelling) {
    Builder builder;
    const std::string uri = builder.json["buffers"][0]["uri"], data = uri.substr(uri.find(','));
    builder.folder.write("data/Corners 1.bin", Bytes(36));
    builder.folder.write("Other.bin", Bytes(36));
    for (const std::string& spelled :
         {"DATA:application/octet-stream;BASE64" + data, "data:; base64" + data, std::string("data/corners%201.BIN"),
          std::string(R"(data\Corners 1.bin?v=3)"), std::string("file:///home/somebody/other.bin")}) {
        builder.json["buffers"][0]["uri"] = spelled;
        EXPECT_EQ(builder.import().meshes.size(), 1u) << spelled;
    }
    EXPECT_THAT(builder.error(),
                HasSubstr("/buffers/0: names 'file:///home/somebody/other.bin', which is there as 'Other.bin'"));
}

TEST(GltfRepairs, aModelOfWhichNothingIsLeftIsRefused) {
    Builder builder;
    builder.json["buffers"][0]["uri"] = "gone.bin";
    EXPECT_THROW(builder.import(), InputError);
}

/// A node with two parents, one of them itself, and a child that the scene lists as a root.
TEST(GltfRepairs, everyNodeIsDrawnOnce) {
    Builder builder;
    builder.merge(R"({"scenes": [{"nodes": [1, 0, 2, 7]}],
                      "nodes": [{"children": [1, 0]}, {"mesh": 0, "children": [2]}, {"children": [1], "mesh": 0}]})");
    const Scene scene = builder.import();
    ASSERT_THAT(scene.nodes, SizeIs(3));
    EXPECT_TRUE(hasWarning(scene, "has several parents, or is a root as well; the first place counts"));
}

/// Flawed elements are dropped from extensions' arrays too, and indices remain those of the file.
TEST(GltfRepairs, aFlawedVariantMovesNoOther) {
    Builder builder;
    builder.json["materials"] = Json::parse(R"([{"name": "a"}, {"name": "b"}])");
    builder.primitive()["material"] = 0;
    builder.primitive()["extensions"] =
        Json::parse(R"({"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}})");
    builder.json["extensions"] =
        Json::parse(R"({"KHR_materials_variants": {"variants": [{"name": 5}, {"name": "b"}]}})");
    builder.importOptions.variant = "b";
    const Scene scene = builder.import();
    EXPECT_EQ(paintOf(scene).name, "b");
    EXPECT_THAT(scene.variants, ElementsAre("b"));
}

TEST(GltfRepairs, keysAndValuesWithoutPartnersAreLeftOut) {
    for (const std::size_t values : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
        Builder builder;
        const int times = builder.add("SCALAR", {0, 1, 2, 3});
        const int moves = builder.add("VEC3", std::vector<float>(3 * values, 1.0f));
        builder.json["animations"] = Json::array(
            {Json::object({{"samplers", {{{"input", times}, {"output", moves}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}})});
        const AnimationSampler sampler = builder.import().rig.clips.at(0).samplers.at(0);
        EXPECT_EQ(sampler.timesSeconds.size(), std::min(values, std::size_t{4}));
        EXPECT_EQ(sampler.values.size(), 3 * sampler.timesSeconds.size());
    }
}

TEST(GltfRepairs, aQuoteInACommentHidesNoDepthAndNoMemory) {
    const Folder folder;
    const std::string deep = "/*\"*/{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + std::string(200'000, '[') +
                             std::string(200'000, ']') + "}";
    EXPECT_THAT(Builder::errorOf(folder.write("deep.gltf", deep)), HasSubstr("nests deeper than 64"));
    std::string many = "/*\"*/{\"asset\": {\"version\": \"2.0\"}, \"extras\": [{}";
    for (int i = 0; i < 300'000; ++i) many += ",{}";
    EXPECT_THROW(underLedger(importGltf, folder.write("many.gltf", many + "]}"), 16 * kMiB), MemoryRefused);
}

TEST(GltfRepairs, whatJsonDoesNotHaveIsNull) {
    Builder builder;
    builder.material()["alphaCutoff"] = 0.75;
    std::string text = builder.json.dump();
    const auto replace = [&](std::string_view part, std::string_view by) {
        text.replace(text.find(part), part.size(), by);
    };
    replace("0.75", "-1.#IND /* \"half\" */");
    replace("\"asset\":{", "// of a converter, {\n\"asset\": {");
    replace("\"nodes\":[0]", "\"nodes\":[0, ]");
    const Scene scene = underLedger(importGltf, builder.folder.write("model.gltf", text));
    EXPECT_EQ(paintOf(scene).alphaCutoff, Material().alphaCutoff);
    EXPECT_TRUE(hasWarning(scene, "model.gltf:"));
    EXPECT_THAT(Builder::errorOf(builder.folder.write("model.gltf", text)), HasSubstr("is not JSON"));
}

TEST(GltfRepairs, charactersThatAreNoneAreReplaced) {
    Builder builder;
    builder.material()["name"] = "NAME";
    std::string text = builder.json.dump();
    text.replace(text.find("NAME"), 4, "\\ud83d\\ude00 \\ud800\\u0041 \xff\\q \n\xc3\xa9");
    const Scene scene = underLedger(importGltf, builder.folder.write("model.gltf", text));
    EXPECT_EQ(paintOf(scene).name, "\U0001f600 \ufffdA \ufffd\ufffd \ufffd\u00e9");
    EXPECT_TRUE(hasWarning(scene, "characters of none U+FFFD"));
    const auto begin = std::chrono::steady_clock::now();
    const std::string broken(2'000'000, '\xff');
    EXPECT_EQ(mendedJson('"' + broken + '"').text.size(), 2 + 6 * broken.size());
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

// ---- KHR_node_visibility -------------------------------------------------------------------------------------------

TEST(GltfVisibility, whatIsHiddenHidesMeshesAndLightsBelowButNoCamera) {
    Builder builder;
    builder.merge(R"({"extensionsRequired": ["KHR_node_visibility"],
                      "nodes": [{"mesh": 0, "children": [1]},
                                {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [2, 3]},
                                {"mesh": 0, "camera": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0},
                                                                          "KHR_node_visibility": {"visible": true}}}],
                      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
                      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    Scene scene = builder.import();
    const auto instances = [&] {
        std::vector<std::size_t> sizes;
        for (const Node& node : scene.nodes) sizes.push_back(node.instances.size());
        return sizes;
    };
    EXPECT_THAT(instances(), ElementsAre(1, 0, 0, 0));
    EXPECT_THAT(scene.lights, IsEmpty());
    EXPECT_THAT(scene.cameras, SizeIs(1));
    EXPECT_THAT(scene.warnings, IsEmpty());
    builder.json["nodes"][1].erase("extensions");
    scene = builder.import();
    EXPECT_THAT(instances(), ElementsAre(1, 0, 1, 0));
    EXPECT_THAT(scene.lights, SizeIs(1));
}

} // namespace
} // namespace tessera::scenes::gltf::test
