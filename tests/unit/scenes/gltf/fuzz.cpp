#include <random>
#include <sstream>

#include <meshoptimizer.h>

#include "DracoStream.h"
#include "GltfBuilder.h"
#include "scenes/Pose.h"
#include "tests/support/Sweep.h"
#include "tests/support/UnderLedger.h"

namespace tessera::scenes::gltf::test {
namespace {

/// A document that uses most features of the importer.
Json richDocument() {
    Builder builder;
    builder.material().merge_patch(Json::parse(R"({"alphaMode": "MASK", "normalTexture": {"index": 0, "scale": 0.5},
        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": {"index": 0, "texCoord": 1,
            "extensions": {"KHR_texture_transform": {"offset": [0, 0], "rotation": 1, "scale": [2, 2], "texCoord": 0}}}},
        "extensions": {"KHR_materials_ior": {"ior": 1.4}, "KHR_materials_specular": {"specularColorTexture": {"index": 0}}}})"));
    builder.addTexture();
    builder.merge(R"({"samplers": [{"magFilter": 9728, "wrapS": 33071}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10}},
                    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 1, 1], "range": 5,
            "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
        "nodes": [{"mesh": 0, "children": [1], "rotation": [0, 0, 0, 1]}, {"camera": 0, "children": [2], "scale": [1, 2, 3]},
                  {"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    builder.json["textures"][0]["sampler"] = 0;
    builder.attribute("TEXCOORD_0", "VEC2", std::vector<float>(6, 0.5f));
    builder.attribute("COLOR_0", "VEC3", std::vector<std::uint8_t>(12, 9), true, 4);
    builder.indices<std::uint16_t>({0, 1, 2});
    builder.makeSparse<std::uint8_t>(0, {1}, {1, 2, 3});

    const std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::vector<unsigned char> encoded(meshopt_encodeVertexBufferBound(3, 12));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), normals.data(), 3, 12));
    builder.attribute("NORMAL", "VEC3", normals);
    const int source = builder.addView(bytesOf(encoded));
    Json& view = builder.json["bufferViews"][std::size_t(source - 1)];
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", source},     {"byteLength", encoded.size()},
                                                     {"byteStride", 12},     {"count", 3},
                                                     {"mode", "ATTRIBUTES"}, {"filter", "NONE"}};
    const Json strip = Json::parse(R"({"attributes": {"POSITION": 0}, "mode": 3, "material": 0})");
    builder.json["meshes"][0]["primitives"].push_back(strip);
    return builder.json;
}

/// Same, for animation and deformation.
Json richRig() {
    Builder builder;
    builder.material();
    builder.merge(R"({"nodes": [{"mesh": 0, "skin": 0, "weights": [0.5]}, {"children": [2], "camera": 0},
                                {"translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                                {"scale": [1, 2, 1]}],
        "scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2, 3], "skeleton": 1}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    Json& primitive = builder.primitive();
    primitive["attributes"]["JOINTS_0"] = builder.add<std::uint8_t>("VEC4", {0, 1, 2, 0, 0, 1, 2, 0, 0, 1, 2, 0});
    primitive["attributes"]["WEIGHTS_0"] = builder.add("VEC4", std::vector<float>(12, 0.25f));
    const int added = builder.add("VEC3", std::vector<float>(9, 0.5f));
    primitive["targets"] = Json::array({Json::object({{"POSITION", added}, {"NORMAL", added}})});
    builder.json["meshes"][0]["weights"] = Json::array({1});
    builder.json["skins"][0]["inverseBindMatrices"] = builder.add("MAT4", std::vector<float>(48, 1.0f));
    const int input = builder.add("SCALAR", {0, 1});
    const int threes = builder.add("VEC3", {0, 0, 1, 1, 0, 0});
    const int fours = builder.add("VEC4", std::vector<float>(24, 0.5f));
    const int ones = builder.add("SCALAR", {0, 1});
    Json& animation = builder.json["animations"][0];
    animation = Json::parse(R"({"name": "a", "samplers": [{}, {"interpolation": "CUBICSPLINE"},
                                                           {"interpolation": "STEP"}],
        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                     {"sampler": 1, "target": {"node": 2, "path": "rotation"}},
                     {"sampler": 2, "target": {"node": 0, "path": "weights"}},
                     {"sampler": 2, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer":
                         {"pointer": "/extensions/KHR_lights_punctual/lights/0/intensity"}}}},
                     {"sampler": 2, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer":
                         {"pointer": "/materials/0/pbrMetallicRoughness/metallicFactor"}}}}]})");
    const int outputs[] = {threes, fours, ones};
    for (std::size_t i = 0; i < 3; ++i) {
        animation["samplers"][i]["input"] = input;
        animation["samplers"][i]["output"] = outputs[i];
    }
    return builder.json;
}

/// Same, for compression by Draco.
Json richDraco() {
    Builder builder;
    builder.indices<std::uint16_t>({0, 1, 2});
    addDraco(builder, dracoTriangle());
    return builder.json;
}

std::vector<Json> richDocuments() {
    return {richDocument(), richRig(), richDraco()};
}

/// Imports and poses a file, or refuses it as input: any other exception fails the test.
bool isImported(const std::filesystem::path& file) {
    try {
        Scene scene = underLedger(importGltf, file);
        checkScene(scene);
        for (const double time : {0.0, 0.5}) poseScene(scene, time);
        checkScene(scene);
        return true;
    } catch (const InputError& error) {
        EXPECT_STRNE(error.what(), "");
        return false;
    }
}

TEST(GltfFuzz, unharmedDocumentIsImported) {
    const Folder folder;
    for (const Json& document : richDocuments())
        EXPECT_TRUE(isImported(folder.write("model.gltf", document.dump()))) << document.dump();
}

/// Replaces every value by each of these; a reduced sweep takes every fourth, by turns.
void expectReplacedOnesImportedOrRefused() {
    const Folder folder;
    const std::string evil = "-1 0 1 2 7 255 65536 2147483647 4294967295 9007199254740991 0.5 -0.0 {} [] [0] null true "
                             "\"\" \"x\" 1e308 1e38 5121 5126 18446744073709551615 -9223372036854775808";
    std::vector<std::string> values; // an odd number, so that steps of 4 reach all
    std::istringstream words(evil);
    for (std::string value; words >> value;) values.push_back(value);
    std::size_t importedCount = 0, triedCount = 0, turn = 0;
    for (const Json& document : richDocuments()) {
        const Json leaves = document.flatten();
        for (const auto& [pointer, leaf] : leaves.items())
            for (const std::string& value : values) {
                if (!::tessera::test::isWholeSweep() && turn++ % 4 != 0) continue;
                Json harmed = document;
                harmed[Json::json_pointer(pointer)] = Json::parse(value);
                SCOPED_TRACE(pointer + " = " + value);
                importedCount += isImported(folder.write("model.gltf", harmed.dump())) ? 1 : 0;
                ++triedCount;
            }
    }
    EXPECT_GT(importedCount, 0u);
    EXPECT_LT(importedCount, triedCount);
}
TEST(GltfFuzz, anyOneValueReplacedIsImportedOrRefused) {
    expectReplacedOnesImportedOrRefused();
}
TEST(GltfFuzzSlow, anyOneValueReplacedIsImportedOrRefused) {
    expectReplacedOnesImportedOrRefused();
}

TEST(GltfFuzz, anyOneValueRemovedIsImportedOrRefused) {
    const Folder folder;
    for (const Json& document : richDocuments()) {
        const Json leaves = document.flatten();
        for (const auto& [pointer, leaf] : leaves.items())
            for (Json::json_pointer place(pointer); !place.empty(); place.pop_back()) {
                Json harmed = document;
                Json& parent = harmed[place.parent_pointer()];
                if (parent.is_array())
                    parent.erase(std::size_t(std::stoul(place.back())));
                else
                    parent.erase(place.back());
                SCOPED_TRACE("without " + place.to_string());
                isImported(folder.write("model.gltf", harmed.dump()));
            }
    }
}

TEST(GltfFuzz, randomBytesChangedAreImportedOrRefused) {
    const Folder folder;
    const std::string texts[] = {richDocument().dump(), richRig().dump()};
    std::mt19937 random(1); // the same changes in every run
    for (int round = 0; round < 4000; ++round) {
        std::string harmed = texts[round % 2];
        for (int change = 0; change <= round / 2 % 4; ++change) harmed[random() % harmed.size()] = char(random() % 256);
        SCOPED_TRACE(round);
        isImported(folder.write("model.gltf", harmed));
    }
}

} // namespace
} // namespace tessera::scenes::gltf::test
