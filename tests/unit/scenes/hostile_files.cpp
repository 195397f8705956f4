#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "scenes/import/GltfDocument.h"
#include "scenes/import/JsonReader.h"
#include "scenes/write/SceneOrigin.h"
#include "tests/support/AssetsFolder.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/PictureBytes.h"
#include "tests/unit/scenes/gltf/GltfBuilder.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;
using gltf::test::Builder;

/// Returns the error of loading a file under a memory limit.
template <typename Read>
std::string errorUnder(const Read& read, const std::filesystem::path& file,
                       std::optional<std::uint64_t> limitBytes = {}) {
    return inputErrorOf([&] { underLedger(read, file, limitBytes); });
}

TEST(Memory, aLimitThatIsNotGivenIsHalfOfTheMachinesOrLess) {
    EXPECT_GE(defaultMemoryLimitBytes(), 64 * kMiB);
    const long machineBytes = sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
    EXPECT_LE(defaultMemoryLimitBytes(), std::uint64_t(machineBytes) / 2);
    EXPECT_EQ(sizeText(694), "694 B");
    EXPECT_EQ(sizeText(3 * kMiB / 2), "1.5 MiB");
}

TEST(Memory, theLimitOfAControlGroupIsTheLeastOfItsOwnAndThoseAbove) {
    const TempFolder folder;
    const auto limitOf = [&](const std::string& membership) {
        return groupLimitBytes(folder.write("membership", membership), folder.path() / "groups");
    };
    folder.write("groups/user/session/memory.max", "max\n");
    EXPECT_FALSE(limitOf("0::/user/session\n"));
    folder.write("groups/user/memory.max", "3000\n");
    folder.write("groups/user/session/app/memory.max", "5000\n");
    EXPECT_EQ(limitOf("0::/user/session/app\n"), 3000u);
    folder.write("groups/memory.max", "2000\n");
    EXPECT_EQ(limitOf("0::/of/the/host\n"), 2000u);
    EXPECT_EQ(limitOf("0::/\n"), 2000u);
    folder.write("groups/memory/user/memory.limit_in_bytes", "700\n");
    EXPECT_EQ(limitOf("5:cpu,cpuacct:/user\n4:hugetlb,memory:/user\n"), 700u);
    EXPECT_FALSE(limitOf("5:cpu:/user\nbroken\n"));
}

TEST(Messages, quoteNoMoreOfABrokenFileThanALine) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("a.json", R"({"tessera": )" + std::string(1'000'000, ' '));
    const std::string error = inputErrorOf([&] { loadScene(file.string()); });
    EXPECT_LT(error.size(), 500 + file.string().size());
    EXPECT_THAT(error, HasSubstr("a.json:1:1000013: "));
}

TEST(Memory, accessorsThatAreReadAgainAndAgainAreCharged) {
    // A few hundred bytes: one accessor of a million zeros, drawn by hundreds of primitives.
    Builder builder;
    builder.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 1'000'000}});
    const std::size_t zeros = builder.json["accessors"].size() - 1;
    for (int i = 0; i < 100; ++i)
        builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}});
    const TempFolder folder;
    const std::filesystem::path file = folder.write("m.gltf", builder.json.dump());
    const std::string error = errorUnder(importGltf, file, 256 * kMiB);
    EXPECT_THAT(error, AllOf(HasSubstr("m.gltf: /"), HasSubstr("of memory"), HasSubstr("may take 256.0 MiB"),
                             HasSubstr("memory limit")));
}

TEST(Memory, instancesAreCharged) {
    Builder builder; // 2000 nodes of a mesh of 2000 primitives: 4 million instances
    for (int i = 0; i < 2000; ++i) builder.json["meshes"][0]["primitives"].push_back(builder.primitive());
    builder.json["nodes"] = gltf::test::Json::array();
    for (int i = 0; i < 2000; ++i) builder.json["nodes"].push_back({{"mesh", 0}});
    builder.json.erase("scenes");
    builder.json.erase("scene");
    const TempFolder folder;
    const std::filesystem::path file = folder.write("m.gltf", builder.json.dump());
    EXPECT_EQ(underLedger(importGltf, file, 128 * kMiB).nodes.size(), 2000u);
    EXPECT_THAT(errorUnder(importGltf, file, 24 * kMiB), HasSubstr("m.gltf: /nodes/"));
}

/// A PNG of 8192 x 8192 texels of one bit, all 0; only its header is ever read.
std::string pictureBomb() {
    return kPngBegin + pngChunk("IHDR", std::string("\0\0\x20\0\0\0\x20\0\x01\0\0\0\0", 13)) +
           std::string("\0\0\x10\0IDAT", 8) + std::string(4096, '\0');
}

TEST(Memory, picturesAreChargedFromTheirHeader) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("bomb.png", pictureBomb());
    EXPECT_THAT(errorUnder(readImage, file, 64 * kMiB),
                AllOf(HasSubstr("bomb.png: the picture of 8192x8192 texels"), HasSubstr("needs 256.0 MiB")));
}

TEST(Memory, aModelOfAnyNumberOfPicturesThatCannotBeReadIsRefusedAfterSomeOfThem) {
    constexpr int kImages = 20; // each claims 256 MiB, and its file adds to that
    Builder builder;
    builder.folder.write("bomb.png", pictureBomb());
    builder.attribute("TEXCOORD_0", "VEC2", {0, 0, 1, 0, 0, 1});
    gltf::test::Json &images = builder.json["images"], &textures = builder.json["textures"];
    gltf::test::Json &materials = builder.json["materials"], &primitives = builder.json["meshes"][0]["primitives"];
    const gltf::test::Json primitive = primitives[0];
    primitives = gltf::test::Json::array();
    for (int i = 0; i < kImages; ++i) {
        images.push_back({{"uri", "bomb.png"}});
        textures.push_back({{"source", i}});
        materials.push_back({{"emissiveTexture", {{"index", i}}}});
        primitives.push_back(primitive);
        primitives.back()["material"] = i;
    }
    const std::filesystem::path file = builder.folder.write("m.gltf", builder.json.dump());
    EXPECT_THAT(errorUnder(importGltf, file, 512 * kMiB),
                HasSubstr("m.gltf: /images/15: the pictures up to here that cannot be read took 4.0 GiB of memory, and "
                          "4.0 GiB at most are spent on them"));
}

TEST(Memory, theFilesOfABuiltinSceneAreChargedAndRecordedWithTheLoad) {
    const TempFolder folder;
    const tessera::test::AssetsFolder assets(folder.path().c_str());
    const std::string scan =
        folder.write("LeePerrySmith/head.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").parent_path();
    std::vector<std::string> files{scan + "/head.obj"};
    for (const char* name : {"albedo_2k.jpg", "specular_2k.jpg", "normal_object_2k.jpg"}) {
        folder.write(std::string("LeePerrySmith/") + name,
                     "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x82");
        files.push_back(scan + "/" + name);
    }
    LoadOptions options;
    std::vector<std::string> read;
    options.files = &read;
    EXPECT_EQ(loadScene("head", options).images.size(), 3u);
    EXPECT_EQ(read, files);

    folder.write("LeePerrySmith/albedo_2k.jpg", pictureBomb());
    options.memoryLimitBytes = builtinScene("head")->bytes + kMiB;
    EXPECT_THAT(inputErrorOf([&] { loadScene("head", options); }),
                HasSubstr("albedo_2k.jpg: the picture of 8192x8192 texels: needs 256.0 MiB of memory"));
}

TEST(Memory, aBuiltinSceneThatIsIncludedIsChargedBeforeItIsMade) {
    const TempFolder folder;
    const std::filesystem::path file =
        folder.write("s.json", R"({"tessera": 1, "include": [{"file": "builtin:hall"}]})");
    EXPECT_THAT(errorUnder(importSceneJson, file, kMiB),
                AllOf(HasSubstr("s.json: 'hall': needs " + sizeText(builtinScene("hall")->bytes)),
                      HasSubstr("may take 1.0 MiB")));
}

TEST(Memory, claimedSizesAreCheckedBeforeReadersAllocate) {
    const TempFolder folder;
    const std::string gif("GIF89a\x20\x4e\x20\x4e\x80\0\0\0\0\0\0\0\0,\0\0\0\0\x20\x4e\x20\x4e\0\x02\x02\x4c\x01\0;",
                          35);
    EXPECT_THAT(errorUnder(readImage, folder.write("a.gif", gif)),
                HasSubstr("a.gif: the picture has 20000x20000 texels"));
    std::string exr("\x76\x2f\x31\x01\x02\0\0\0dataWindow\0box2i\0\x10\0\0\0", 29);
    exr += std::string("\0\0\0\x80\0\0\0\x80\xff\xff\xff\x7f\xff\xff\xff\x7f\0", 17);
    EXPECT_THAT(errorUnder(readImage, folder.write("a.exr", exr)),
                HasSubstr("a.exr: the picture has 4294967296x4294967296 texels"));
}

/// Returns the error of an EXR with this first attribute, without the file's name.
std::string refusalOfExr(const std::string& type, const std::string& sizeAndValue) {
    const TempFolder folder;
    const std::string exr = std::string("\x76\x2f\x31\x01\x02\0\0\0", 8) + "owner" + '\0' + type + '\0' + sizeAndValue;
    const std::filesystem::path file = folder.write("a.exr", exr);
    const std::string error = errorUnder(readImage, file);
    EXPECT_THAT(error, StartsWith(file.string() + ": the openexr picture cannot be decoded ("));
    const std::size_t first = error.find('(');
    return error.substr(first, error.find(')') + 1 - first);
}

TEST(Memory, aValueOfAnExrHeaderIsNotReservedUnlessTheFileHoldsIt) {
    const std::string twoGiB("\xff\xff\xff\x7f", 4), eight("\x08\0\0\0", 4);
    const struct {
        std::string type, sizeAndValue, flaw;
    } cases[] = {{"string", twoGiB + "abcd", "claims 2147483647 bytes where 4 are left"},
                 {"none of its own", twoGiB + "abcd", "claims 2147483647 bytes where 4 are left"},
                 {"stringvector", eight + twoGiB + "abcd", "claims 2147483647 bytes where 4 are left"},
                 // Allocations that the reader makes without checking the size would hide the later ones.
                 {"box2i", eight + "abcdefgh", "claims 8 bytes and has 16"},
                 {"chlist", std::string("\x02\0\0\0\0abcdefgh", 13), "has 2 bytes: its list of channels ends earlier"},
                 // OpenEXR reads past a list without an end, where an attribute may claim anything.
                 {"chlist", std::string("\x12\0\0\0R\0", 6) + std::string(16, '\1'),
                  "has 18 bytes: its list of channels has no end"},
                 {"chlist", std::string("\x06\0\0\0R\0\1\1\1\1", 10), "has 6 bytes: its list of channels has no end"},
                 {"floatvector", std::string("\x06\0\0\0abcdef", 10), "has 6 bytes: a number takes 4"}};
    for (const auto& one : cases)
        EXPECT_EQ(refusalOfExr(one.type, one.sizeAndValue),
                  "(its attribute 'owner' of type " + one.type + " " + one.flaw + ")");
}

TEST(Memory, aFileStaysChargedForItsRemainingMemory) {
    const SceneFolder folder;
    LoadLedger ledger(64 * kMiB);
    for (int i = 0; i < 1000; ++i) { // far more in total than one may take
        const std::uint64_t before = ledger.usedBytes();
        const Scene scene = importObj(folder.path() / "models/bust.obj", ledger);
        ASSERT_EQ(ledger.usedBytes() - before, bytesOf(scene));
    }
}

TEST(Memory, copiesOfAnIncludeAreChargedAndItsFileReadTwiceAtMost) {
    const SceneFolder folder;
    std::string big = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 2000; ++i) big += "f 1 2 3\n";
    folder.write("models/big.obj", big);
    const std::string text = R"({"tessera": 1, "include": [)" +
                             listOf(1000, [](int) { return std::string(R"({"file": "models/big.obj"})"); }) + "]}";
    const std::filesystem::path file = folder.write("scene.json", text);
    LoadLedger ledger;
    EXPECT_EQ(importSceneJson(file, ledger).meshes.size(), 1000u);
    EXPECT_LE(ledger.files().size(), 3u);
    EXPECT_THAT(errorUnder(importSceneJson, file, 16 * kMiB),
                AllOf(HasSubstr("scene.json: include"), HasSubstr("models/big.obj")));
}

TEST(Memory, keptIncludesAreChargedWhenTheirDocumentIsRead) {
    const SceneFolder folder;
    std::string big;
    for (int i = 0; i < 200; ++i) big += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf -3 -2 -1\n", i);
    constexpr int kDocuments = 60;
    for (int i = 0; i < kDocuments; ++i) {
        folder.write(fmt::format("big{}.obj", i), big);
        const std::string include = fmt::format(R"({{"file": "big{}.obj"}})", i);
        folder.write(fmt::format("part{}.json", i), R"({"tessera": 1, "include": [)" + include + "," + include + "]}");
    }
    const std::string text = R"({"tessera": 1, "include": [)" +
                             listOf(kDocuments, [](int i) { return fmt::format(R"({{"file": "part{}.json"}})", i); }) +
                             "]}";
    const std::filesystem::path file = folder.write("scene.json", text);
    LoadLedger ledger;
    const std::uint64_t sceneBytes = bytesOf(importSceneJson(file, ledger));
    EXPECT_EQ(ledger.usedBytes(), sceneBytes);
    // The scene holds each file twice, and the importer a third copy.
    EXPECT_THAT(errorUnder(importSceneJson, file, sceneBytes * 5 / 4), HasSubstr("of memory"));
}

TEST(Memory, theOriginOfASceneNeverTakesMoreThanADocumentAtATime) {
    const TempFolder folder;
    folder.write("shared.json",
                 R"({"tessera": 1, "name": ")" + std::string(4000, 'n') + "\"" + std::string(100'000, ' ') + "}");
    const std::string file = folder.file("s.json", R"({"tessera": 1, "include": [)" + listOf(1000, [](int) {
                                                       return std::string(R"({"file": "shared.json"})");
                                                   }) + "]}");
    LoadOptions options = loading(&LoadOptions::memoryLimitBytes, 16 * kMiB);
    const Scene scene = loadScene(file, options);
    EXPECT_EQ(originOf(file, options, scene).documents.size(), 2u);
    options.memoryLimitBytes = bytesOf(scene) + 1000;
    EXPECT_THAT(inputErrorOf([&] { originOf(file, options, scene); }),
                HasSubstr(sizeText(bytesOf(scene)) + " are in use"));
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool kHeapIsCounted = false; // mallinfo2() does not cover the sanitizer's heap
#else
constexpr bool kHeapIsCounted = true;
#endif

std::size_t heapBytes() {
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

TEST(Memory, aParsedDocumentNeverTakesMoreThanItIsChargedFor) {
    if (!kHeapIsCounted) GTEST_SKIP() << "the heap is the sanitizer's";
    constexpr int kCount = 100'000;
    for (const char* element :
         {"0", "[]", "{}", R"("")", R"("sixteen letters!")", R"({"":0})", R"({"a":"b","c":[0]})"}) {
        const std::string text = "[" + listOf(kCount, [&](int) { return std::string(element); }) + "]";
        const std::size_t before = heapBytes();
        const nlohmann::json document = nlohmann::json::parse(text);
        EXPECT_LE(heapBytes() - before, parsedJsonBytes(text)) << element;
        // A growing array also holds its old storage, half as large, during the copy.
        EXPECT_GE(parsedJsonBytes(text), kCount * 3 * sizeof(nlohmann::json)) << element;
    }
}

TEST(Memory, whatIsKeptOfAGltfFileNeverTakesMoreThanItIsChargedFor) {
    if (!kHeapIsCounted) GTEST_SKIP() << "the heap is the sanitizer's";
    struct Case {
        const char* before; ///< before the repeated elements
        const char* element;
        const char* after;
        const char* node = "0"; ///< refers to each element by its number, @; else none
    };
    constexpr Case kCases[] = {
        {R"("scenes": [)", R"({"nodes": [0]})", "]", R"({"children": [0]})"},
        {R"("meshes": [)", R"({"primitives": [{"attributes": {}}]})", "]", R"({"mesh": @})"},
        {R"("meshes": [{"primitives": [{"attributes": {}, "targets": [)", "{}", "]}]}]", R"({"mesh": 0})"},
        {R"("meshes": [{"primitives": [{"attributes": {}, "targets": [)", R"({"A": 0, "B": 0})",
         R"(]}]}], "accessors": [{"componentType": 5121, "count": 1, "type": "SCALAR"}])", R"({"mesh": 0})"},
        {R"("meshes": [)", R"({"primitives": [{"attributes": {"A": 0, "B": 0}}]})",
         R"(], "accessors": [{"componentType": 5121, "count": 1, "type": "SCALAR"}])", R"({"mesh": @})"},
        {R"("accessors": [)", R"({"componentType": 5121, "count": 1, "type": "SCALAR"})", "]",
         R"({"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": @}}}})"},
        {R"("buffers": [)", R"({"byteLength": 1})", "]"},
        {R"("bufferViews": [)", R"({"buffer": 0, "byteLength": 1})", R"(], "buffers": [{"byteLength": 1}])"},
        {R"("images": [)", "{}", "]"},
        {R"("textures": [)", "{}", "]"},
        {R"("samplers": [)", "{}", "]"},
        {R"("meshes": [{"primitives": [{"attributes": {}, "material": 0}]}], "materials": [)", "{}", "]",
         R"({"mesh": 0})"},
        {R"("cameras": [)", R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}})", "]",
         R"({"camera": @})"},
        {R"("extensions": {"KHR_lights_punctual": {"lights": [)", R"({"type": "point"})", "]}}",
         R"({"extensions": {"KHR_lights_punctual": {"light": @}}})"},
        {R"("skins": [)", R"({"joints": [0]})", "]", R"({"skin": @})"},
        {R"("animations": [)", R"({"samplers": [], "channels": []})", "]"},
        {R"("animations": [{"channels": [], "samplers": [)", R"({"input": 0, "output": 0})",
         R"(]}], "accessors": [{"componentType": 5121, "count": 1, "type": "SCALAR"}])"},
        {R"("animations": [{"samplers": [{"input": 0, "output": 0}], "channels": [)",
         R"({"sampler": 0, "target": {"node": 0, "path": "rotation"}})",
         R"(]}], "accessors": [{"componentType": 5121, "count": 1, "type": "SCALAR"}])"},
        {R"("extensionsUsed": [)", R"("A")", "]"}};
    const TempFolder folder;
    for (const Case& test : kCases) {
        const auto elementAt = [&](int) { return std::string(test.element); };
        const auto nodeAt = [&](int i) {
            std::string node = test.node;
            if (const std::size_t number = node.find('@'); number != node.npos)
                node.replace(number, 1, fmt::format("{}", i));
            return node;
        };
        const std::string text = R"({"asset": {"version": "2.0"}, )" + std::string(test.before) +
                                 listOf(20'000, elementAt) + test.after + R"(, "nodes": [)" + listOf(20'000, nodeAt) +
                                 "]}";
        const std::filesystem::path file = folder.write("m.gltf", text);
        LoadLedger ledger;
        const std::size_t heapBefore = heapBytes();
        Repairs repairs(false);
        const gltf::Document document = gltf::loadDocument(file, ledger, repairs);
        const std::size_t keptBytes = heapBytes() - heapBefore;
        // The ledger also counts the file, its text and the parsed JSON, all of which are freed.
        const std::uint64_t chargedBytes = ledger.usedBytes() - 2 * text.size() - parsedJsonBytes(text);
        constexpr std::size_t kNamesBytes = 4096; // the file's names
        EXPECT_GT(keptBytes, 20'000u) << test.before;
        EXPECT_LE(keptBytes, chargedBytes + kNamesBytes) << test.before << test.element;
    }
}

TEST(Memory, aBufferThatIsTooLargeIsNamedOnce) {
    Builder builder;
    builder.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + std::string(4 * kMiB, 'A');
    const TempFolder folder;
    const std::filesystem::path file = folder.write("m.gltf", builder.json.dump());
    EXPECT_THAT(errorUnder(importGltf, file, 16 * kMiB), StartsWith(file.string() + ": /buffers/0: needs"));
}

TEST(Memory, everyWarningOfAGltfFileIsCharged) {
    const TempFolder folder;
    std::string primitives;
    for (int i = 0; i < 1000; ++i) primitives += fmt::format(R"({}{{"attributes": {{}}}})", i == 0 ? "" : ",");
    const std::filesystem::path file =
        folder.write("m.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],)"
                               R"("meshes": [{"name": ")" +
                                   std::string(100'000, 'a') + R"(", "primitives": [)" + primitives + "]}]}");
    EXPECT_THAT(errorUnder(importGltf, file, 32 * kMiB), HasSubstr("its warnings"));
}

TEST(Memory, everyMeshOfAnObjFileIsCharged) {
    const TempFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 20'000; ++i) text += "g\nf 1 2 3\n";
    const std::filesystem::path file = folder.write("m.obj", text);
    EXPECT_THAT(errorUnder(importObj, file, 32 * kMiB), HasSubstr("m.obj:"));
}

TEST(Memory, statementsThatAreLeftOutAreChargedForTheirWarning) {
    const TempFolder folder;
    std::string unknown;
    for (int i = 0; i < 100'000; ++i) unknown += fmt::format("u{}\n", i);
    const std::string model = "mtllib m.mtl\nv 0 0 0\nf 1 1 1\n";
    const std::filesystem::path obj = folder.write("m.obj", model + unknown);
    EXPECT_THAT(errorUnder(importObj, obj, 8 * kMiB), HasSubstr("m.obj:"));
    folder.write("m.obj", model);
    folder.write("m.mtl", "newmtl m\n" + unknown);
    EXPECT_THAT(errorUnder(importObj, obj, 8 * kMiB), HasSubstr("m.mtl:"));
}

TEST(Memory, jsonAndObjTextsAreCharged) {
    const TempFolder folder;
    const std::filesystem::path json = folder.write(
        "s.json", R"({"tessera": 1, "lights": [)" + listOf(300'000, [](int) { return std::string("[]"); }) + "]}");
    EXPECT_THAT(errorUnder(importSceneJson, json, 8 * kMiB), HasSubstr("s.json: its JSON"));
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 100'000; ++i) text += "f 1 2 3\n";
    const std::filesystem::path obj = folder.write("m.obj", text);
    EXPECT_THAT(errorUnder(importObj, obj, 8 * kMiB), HasSubstr("m.obj:"));
}

} // namespace
} // namespace tessera::scenes
