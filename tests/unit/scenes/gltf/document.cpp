#include <limits>

#include "GltfBuilder.h"
#include "tests/support/UnderLedger.h"

namespace tessera::scenes::gltf::test {
namespace {

/// A .glb of `json` and, when given, a binary chunk.
Bytes glbOf(const Json& json, const Bytes* binary) {
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::vector<std::uint32_t> words = {0x46546c67, 2, 0, std::uint32_t(text.size()), 0x4e4f534a};
    Bytes bytes = bytesOf(words);
    const Bytes body = bytesOf(text);
    bytes.insert(bytes.end(), body.begin(), body.end());
    if (binary != nullptr) {
        const Bytes header = bytesOf(std::vector<std::uint32_t>{std::uint32_t(binary->size()), 0x004e4942});
        bytes.insert(bytes.end(), header.begin(), header.end());
        bytes.insert(bytes.end(), binary->begin(), binary->end());
    }
    const auto length = std::uint32_t(bytes.size());
    std::memcpy(&bytes[8], &length, 4);
    return bytes;
}

Bytes triangleGlb() {
    Builder builder;
    builder.json["buffers"][0].erase("uri");
    const Bytes binary = bytesOf(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    return glbOf(builder.json, &binary);
}

std::string errorOfBytes(const Bytes& bytes) {
    const Folder folder;
    return Builder::errorOf(folder.write("model.glb", bytes));
}

std::string errorOfText(const std::string& text) {
    const Folder folder;
    return Builder::errorOf(folder.write("model.gltf", text));
}

TEST(GltfDocument, glbIsReadLikeGltf) {
    const Folder folder;
    const Scene scene = underLedger(importGltf, folder.write("model.glb", triangleGlb()));
    EXPECT_EQ(scene.meshes.at(0).positionsOS.at(2), glm::vec3(0, 1, 0));
}

TEST(GltfDocument, brokenGlbIsRefused) {
    const Bytes good = triangleGlb();
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_NE(errorOfBytes(Bytes(good.begin(), good.begin() + std::ptrdiff_t(size))), "") << size;
    EXPECT_THAT(errorOfBytes(Bytes(good.begin(), good.begin() + 100)),
                HasSubstr("model.glb: the glb is cut short or broken: its header says"));
    struct Harm {
        std::size_t at;
        int value;
        const char* error;
    };
    for (const Harm& harm : {Harm{0, 'X', "is neither glTF JSON (begins with '{') nor glb (begins with 'glTF')"},
                             {4, 1, "is glb version 1; only version 2"},
                             {15, 0x7f, "chunk 0 says"},
                             {16, 'X', "its first chunk is not JSON"}}) {
        Bytes bad = good;
        bad[harm.at] = std::byte(harm.value);
        EXPECT_THAT(errorOfBytes(bad), HasSubstr(harm.error));
    }
}

TEST(GltfDocument, documentsThatAreNoGltfAreRefused) {
    EXPECT_THAT(Builder::errorOf("/nowhere/model.gltf"), HasSubstr("/nowhere/model.gltf: there is no such file"));
    EXPECT_THAT(Builder::errorOf(std::filesystem::temp_directory_path()), HasSubstr("is not a regular file"));
    for (const auto& [text, error] :
         {std::pair("", "model.gltf: the file is empty; export the model again"),
          {"solid cube", "is neither glTF JSON"},
          {"<!DOCTYPE html>", "it is a web page: download the file itself"},
          {"version https://git-lfs.github.com/spec/v1", "it names a file of Git LFS: run git lfs pull"},
          {R"({"asset": )", "is not JSON: parse error at line 1"},
          {"{}", "/asset: is missing"},
          {R"({"asset": {"version": "1.0"}})", "/asset/version: is '1.0', but only glTF 2.0"},
          {R"({"asset": {"version": "2.0", "minVersion": "2.1"}})", "/asset/minVersion: is '2.1'"}})
        EXPECT_THAT(errorOfText(text), HasSubstr(error));
}

TEST(GltfDocument, deeplyNestedJsonNeverOverflowsTheStack) {
    const std::string deep = std::string(200000, '[') + std::string(200000, ']');
    EXPECT_THAT(errorOfText(R"({"asset": {"version": "2.0"}, "extras": )" + deep + "}"),
                HasSubstr("nests deeper than 64"));
}

TEST(GltfDocument, emptySceneIsImported) {
    const Folder folder;
    EXPECT_TRUE(underLedger(importGltf, folder.write("model.gltf", R"({"asset": {"version": "2.0"}})")).nodes.empty());
}

TEST(GltfDocument, aRequiredExtensionThatIsNotSupportedIsLeftOutUnlessItCompresses) {
    Builder builder;
    builder.merge(R"({"extensionsRequired": ["KHR_gaussian_splatting", "KHR_texture_basisu"]})");
    const char* kText = "/extensionsRequired: the model requires KHR_gaussian_splatting, which is not supported";
    EXPECT_THAT(builder.error(), HasSubstr(kText));
    EXPECT_TRUE(
        hasWarning(builder.import(), std::string(kText) + "; export it without; it is drawn without (and 1 more)"));
    builder.merge(R"({"extensionsUsed": ["KHR_gaussian_splatting", "KHR_texture_basisu"]})");
    EXPECT_FALSE(hasWarning(builder.import(), "is not supported and was ignored")) << "it is reported twice";
    builder.merge(R"({"extensionsRequired": ["EXT_some_compression"]})");
    EXPECT_THROW(builder.import(), InputError);
}

TEST(GltfDocument, optionalExtensionThatIsNotSupportedIsWarnedOfWithItsReplacement) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_diffuse_transmission", "KHR_materials_unlit"]})");
    const Scene scene = builder.import();
    EXPECT_TRUE(hasWarning(scene, "the extension KHR_materials_diffuse_transmission is not supported and was ignored; "
                                  "its materials let through only what their alpha does"));
    EXPECT_FALSE(hasWarning(scene, "unlit"));
}

TEST(GltfDocument, dispersionIsTakenWithoutAWarning) {
    Builder builder;
    builder.merge(R"({"extensionsUsed": ["KHR_materials_dispersion"],
                      "extensionsRequired": ["KHR_materials_dispersion"]})");
    EXPECT_FALSE(hasWarning(builder.import(), "KHR_materials_dispersion"));
}

TEST(GltfDocument, integersWithADecimalPointAreReadExactly) {
    Builder builder;
    builder.json["accessors"][0]["count"] = 3.0;
    EXPECT_EQ(builder.import().meshes.at(0).positionsOS.size(), 3u);
    builder.json["accessors"][0]["count"] = 2.5;
    EXPECT_THAT(builder.error(), HasSubstr("/accessors/0/count: must be an integer, but is 2.5"));
}

struct Fault {
    const char* pointer; ///< the replaced value
    const char* value;
    const char* error; ///< part of the text
};

constexpr Fault kShapeFaults[] = {
    {"/scene", "\"0\"", "/scene: must be an integer, but is string"},
    {"/scene", "-1", "/scene: is -1; it must be at least 0"},
    {"/scene", "3", "/scene: points at /scenes/3, but there are only 1"},
    {"/scenes", "{}", "/scenes: must be an array, but is object"},
    {"/scenes/0/nodes/0", "9", "/scenes/0/nodes/0: points at /nodes/9, but there are only 1"},
    {"/nodes", "[7]", "/nodes/0: must be an object, but is number"},
    {"/nodes/0/mesh", "1", "/nodes/0/mesh: points at /meshes/1, but there are only 1"},
    {"/nodes/0/camera", "0", "/nodes/0/camera: points at /cameras/0, but the document has no cameras"},
    {"/nodes/0/translation", "[1, 2]", "/nodes/0/translation: must hold 3 numbers, but holds 2"},
    {"/nodes/0/scale", "[1, 2, null]", "/nodes/0/scale/2: must be a number, but is null"},
    {"/nodes/0/matrix", "true", "/nodes/0/matrix: must be an array of numbers, but is boolean"},
    {"/nodes/0/translation", "[1e300, 0, 0]", "/nodes/0/translation/0: is 1e+300, which no 32-bit"},
    {"/meshes/0", "{}", "/meshes/0: the required property 'primitives' is missing"},
    {"/meshes/0/primitives", "{}", "/meshes/0/primitives: must be an array, but is object"},
    {"/meshes/0/primitives/0", "{}", "the required property 'attributes' is missing"},
    {"/meshes/0/primitives/0/mode", "7", "/mode: is 7; it must be at most 6"},
    {"/meshes/0/primitives/0/attributes/POSITION", "1", "points at /accessors/1, but there are only 1"},
    {"/meshes/0/primitives/0/indices", "-2", "/indices: is -2; it must be at least 0"},
    {"/materials/0/alphaMode", "\"GLASS\"", "is 'GLASS'; valid are OPAQUE, MASK, BLEND"},
    {"/materials/0/doubleSided", "1", "/materials/0/doubleSided: must be true or false, but is 1"},
    {"/materials/0/normalTexture", "{}", "/materials/0/normalTexture: the required property 'index' is missing"},
    {"/materials/0/emissiveTexture", "{\"index\": 0}", "but the document has no textures"},
    {"/materials/0/pbrMetallicRoughness", "{\"metallicFactor\": 2}", "metallicFactor: is 2; it must be at most 1"},
    {"/materials/0/pbrMetallicRoughness", "[]", "/pbrMetallicRoughness: must be an object, but is array"},
    {"/materials/0/extensions", "{\"KHR_materials_ior\": 2}", "/KHR_materials_ior: must be an object, but is number"},
    {"/nodes/0/extensions", "{\"KHR_lights_punctual\": {}}",
     "/nodes/0/extensions/KHR_lights_punctual: the required property 'light' is missing"},
    {"/materials/0/emissiveFactor", "[-1, 0, 0]", "/materials/0/emissiveFactor/0: is -1; it must be at least 0"}};

constexpr Fault kDataFaults[] = {
    {"/accessors/0/count", "4", "model.gltf: /accessors/0: reads 12 bytes past the end of buffer view 0"},
    {"/accessors/0/count", "0", "/accessors/0/count: is 0; it must be at least 1"},
    {"/accessors/0/count", "4000000000", "/accessors/0: reads 47999999964 bytes past the end of buffer view 0"},
    {"/accessors/0/count", "9007199254740992", "/accessors/0: reads "},
    {"/accessors/0/count", "18446744073709551615",
     "/accessors/0/count: is 18446744073709551615, farther from 0 than 9007199254740992"},
    {"/accessors/0/byteOffset", "9007199254740991", "/accessors/0: reads 9007199254740991 bytes past the end"},
    {"/accessors/0/byteOffset", "-4", "/accessors/0/byteOffset: is -4; it must be at least 0"},
    {"/accessors/0/byteOffset", "4", "/accessors/0: reads 4 bytes past the end of buffer view 0"},
    {"/accessors/0/componentType", "5124", "componentType: is 5124; valid are 5120, 5121, 5122, 5123, 5125, 5126"},
    {"/accessors/0/type", "\"VEC5\"", "/accessors/0/type: is 'VEC5'; valid are SCALAR"},
    {"/accessors/0/bufferView", "1", "/accessors/0/bufferView: points at /bufferViews/1, but there are only 1"},
    {"/accessors/0/sparse", "{\"count\": 1}", "/accessors/0/sparse: the required property 'indices' is missing"},
    {"/bufferViews/0/byteLength", "37", "/bufferViews/0: reads 1 bytes past the end of buffer 0"},
    {"/bufferViews/0/byteOffset", "9007199254740991",
     "/bufferViews/0: reads 9007199254740991 bytes past the end of buffer 0"},
    {"/bufferViews/0/byteStride", "8", "has elements of 12 bytes, but buffer view 0 steps only 8 bytes"},
    {"/bufferViews/0/byteStride", "13", "/bufferViews/0/byteStride: is 13; it must be a multiple of 4"},
    {"/bufferViews/0/byteStride", "256", "/bufferViews/0/byteStride: is 256; it must be at most 252"},
    {"/bufferViews/0/buffer", "1", "/bufferViews/0/buffer: points at /buffers/1, but there are only 1"},
    {"/buffers/0/byteLength", "40", "/buffers/0: says 40 bytes, but its data has only 36"},
    {"/buffers/0/uri", "\"gone.bin\"", "gone.bin: there is no such file"},
    {"/buffers/0/uri", "\"\"", "/buffers/0: its uri is empty"},
    {"/buffers/0/uri", "\"data:nonsense\"", "/buffers/0: its data URI has no comma"},
    {"/buffers/0/uri", "\"data:;base64,AAAAA\"", "/buffers/0: its base64 is cut short"},
    {"/buffers/0/uri", "\"a%00b\"", "/buffers/0: its uri holds a zero character"},
    {"/buffers/0", "{\"byteLength\": 36}", "/buffers/0: has neither a uri nor a binary chunk"}};

void expectRefused(const Fault& fault) {
    SCOPED_TRACE(std::string(fault.pointer) + " = " + fault.value);
    Builder builder;
    builder.material();
    builder.json[Json::json_pointer(fault.pointer)] = Json::parse(fault.value);
    EXPECT_THAT(builder.error(), HasSubstr(fault.error));
}

TEST(GltfDocument, wrongShapeIsRefusedWithItsPlace) {
    for (const Fault& fault : kShapeFaults) expectRefused(fault);
}

TEST(GltfDocument, dataOutOfRangeIsRefusedWithItsPlace) {
    for (const Fault& fault : kDataFaults) expectRefused(fault);
}

TEST(GltfDocument, accessorWithoutDataNeverReservesGigabytes) {
    Builder builder;
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["count"] = 4000000000u;
    EXPECT_THAT(builder.error(), HasSubstr("/accessors/0: has 4000000000 elements but no buffer view"));
}

TEST(GltfDocument, objectsThatTinygltfRefusesAreRead) {
    Builder builder;
    builder.merge(R"({"images": [{}, {"uri": "nowhere.png", "bufferView": 0}]})");
    builder.json["accessors"].push_back({{"componentType", 5121}, {"type", "SCALAR"}, {"count", 3}}); // zeros
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.meshes.at(1).indices.size(), 3u);
    EXPECT_TRUE(scene.images.empty());
}

TEST(GltfDocument, sparseFaultsAreRefused) {
    Builder builder;
    Json& sparse = builder.makeSparse<std::uint8_t>(0, {3}, {7, 8, 9});
    EXPECT_THAT(builder.error(), HasSubstr("/accessors/0: sparse index 0 is 3, but there are only 3 elements"));
    sparse["count"] = 2;
    EXPECT_THAT(builder.error(), HasSubstr("/accessors/0: reads 1 bytes past the end of buffer view 1"));
    sparse["count"] = 2000000000;
    EXPECT_THAT(builder.error(), HasSubstr("/accessors/0: replaces 2000000000 elements, but has only 3"));
}

TEST(GltfDocument, bufferIsReadTheSameFromAFileWithSpacesAndUnicode) {
    Builder builder;
    builder.folder.write("d\xc3\xa4ta 1%.bin", bytesOf(std::vector<float>{0, 0, 0, 5, 0, 0, 0, 5, 0}));
    builder.json["buffers"][0]["uri"] = "d%C3%A4ta%201%25.bin";
    EXPECT_EQ(builder.import().meshes.at(0).positionsOS.at(1), glm::vec3(5, 0, 0));
    builder.json["buffers"][0]["uri"] = "d\xc3\xa4ta 1%.bin";
    EXPECT_EQ(builder.import().meshes.at(0).positionsOS.at(1), glm::vec3(5, 0, 0));
}

TEST(GltfDocument, unusedBufferIsNotRead) {
    Builder builder;
    builder.json["buffers"].push_back(Json::parse(R"({"uri": "gone.bin", "byteLength": 9})"));
    EXPECT_EQ(builder.import().meshes.size(), 1u);
}

} // namespace
} // namespace tessera::scenes::gltf::test
