#include <ctime>
#include <functional>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/json/SceneFiles.h"

/// The time of loading grows with the size of the file, and no faster.
namespace tessera::scenes {
namespace {

using test::inputErrorOf;
using test::listOf;
using test::TempFolder;
using testing::HasSubstr;

/// Linear loading takes about a second of each file here; quadratic loading took minutes. The rest is room for
/// slower machines.
#ifdef __SANITIZE_ADDRESS__
constexpr double kSeconds = 100.0; // sanitizers take several times as long
#else
constexpr double kSeconds = 10.0;
#endif

/// Seconds of the processor that `action` takes: other programs do not count.
double secondsOf(const std::function<void()>& action) {
    const std::clock_t start = std::clock();
    action();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(Growth, aHundredThousandMaterialsAndCamerasOfASceneFileTakeSeconds) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write(
        "s.json",
        R"({"tessera": 1, "materials": [)" +
            listOf(100'000, [](int i) { return fmt::format(R"({{"name":"m{}","model":"lambert"}})", i); }) +
            R"(], "cameras": [)" +
            listOf(100'000,
                   [](int i) { return fmt::format(R"({{"name":"c{}","position":[0,0,1],"target":[0,0,0]}})", i); }) +
            "]}");
    const auto load = [&] {
        const Scene scene = underLedger(importSceneJson, file);
        EXPECT_EQ(scene.materials.size(), 100'000u);
        EXPECT_EQ(scene.cameras.size(), 100'000u);
    };
    EXPECT_LT(secondsOf(load), kSeconds);
}

TEST(Growth, aHundredThousandMaterialsOfAnObjFileTakeSeconds) {
    const TempFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 100'000; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
    const std::filesystem::path file = folder.write("m.obj", text);
    EXPECT_LT(secondsOf([&] { EXPECT_EQ(underLedger(importObj, file).materials.size(), 100'000u); }), kSeconds);
}

TEST(Growth, warningsAreNotMoreThanAHundredAndTheirRest) {
    const TempFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::string library;
    for (int i = 0; i < 300; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
    for (int i = 0; i < 300; ++i) library += fmt::format("newmtl m{}\nd 0\n", i);
    folder.write("m.mtl", library);
    LoadOptions options;
    options.defaultLight = false;
    const Scene scene = loadScene(folder.write("m.obj", "mtllib m.mtl\n" + text).string(), options);
    ASSERT_EQ(scene.warnings.size(), 101u);
    EXPECT_EQ(scene.warnings[100], "and 200 more warnings");
}

TEST(Growth, thirtyThousandOverridesOfNodesAndMaterialsByNameTakeSeconds) {
    constexpr int kCount = 30'000;
    const TempFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < kCount; ++i) text += fmt::format("g n{0}\nusemtl m{0}\nf 1 2 3\n", i);
    folder.write("m.obj", text);
    const auto sceneOf = [&](const std::string& overrides) {
        return folder.write(
            "s.json",
            R"({"tessera": 1, "include": [{"file": "m.obj"}], "materials": [)" +
                listOf(kCount, [](int i) { return fmt::format(R"({{"name":"own{}","model":"lambert"}})", i); }) +
                R"(], "overrides": [)" + overrides + "]}");
    };
    const std::filesystem::path named = sceneOf(listOf(kCount, [](int i) {
        return fmt::format(R"({{"material":"m{0}","ior":1.5}},{{"node":"n{0}","material":"own{0}"}})", i);
    }));
    EXPECT_LT(secondsOf([&] { EXPECT_EQ(underLedger(importSceneJson, named).materials.size(), kCount + 0u); }),
              kSeconds);
    const std::filesystem::path patterns =
        sceneOf(listOf(2 * kCount, [](int) { return std::string(R"({"node":"n*","material":"own0"})"); }));
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, patterns); }),
                HasSubstr("/node: the overrides up to here take more than 1000000000 steps"));
}

/// A scene of triangles with these names, to which these overrides give a material.
std::filesystem::path sceneOfNames(const TempFolder& folder, int count, const std::function<std::string(int)>& nameOf,
                                   const std::vector<std::string>& patterns) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < count; ++i) text += "g " + nameOf(i) + "\nf 1 2 3\n";
    folder.write("m.obj", text);
    return folder.write(
        "s.json",
        R"({"tessera": 1, "include": [{"file": "m.obj"}], "materials": [{"name": "own", "model": "lambert"}],
            "overrides": [)" +
            listOf(
                int(patterns.size()),
                [&](int i) { return fmt::format(R"({{"node":"{}","material":"own"}})", patterns[std::size_t(i)]); }) +
            "]}");
}

TEST(Growth, fortyPatternsOverAHundredThousandNodesAreRead) {
    constexpr int kCount = 100'000;
    const TempFolder folder;
    const auto nameOf = [](int i) { return fmt::format("hangar_7/wing_left/engine_2/turbine/blade_{:06}", i); };
    std::vector<std::string> patterns;
    for (int i = 0; i < 40; ++i) patterns.push_back(nameOf(i * 1000).substr(0, 45) + "*");
    const std::filesystem::path file = sceneOfNames(folder, kCount, nameOf, patterns);
    EXPECT_LT(secondsOf([&] { EXPECT_GE(underLedger(importSceneJson, file).nodes.size(), kCount + 0u); }), kSeconds);
}

TEST(Growth, patternsThatBeginAgainAtEveryCharacterAreRefused) {
    const TempFolder folder;
    const std::filesystem::path file =
        sceneOfNames(folder, 2000, [](int i) { return std::string(4000, 'x') + std::to_string(i); },
                     {"*0", "*" + std::string(2000, 'x') + "y*"});
    EXPECT_LT(secondsOf([&] {
                  EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }),
                              HasSubstr("/overrides/1/node: the overrides up to here take more than 1000000000 steps"));
              }),
              kSeconds);
}

TEST(Growth, starsAtTheEndOfAPatternAreCounted) {
    const TempFolder folder;
    const std::filesystem::path file =
        sceneOfNames(folder, 2000, [](int) { return "a"; }, {"a" + std::string(1'000'000, '*')});
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }),
                HasSubstr("/overrides/0/node: the overrides up to here take more than 1000000000 steps"));
}

TEST(Growth, anErrorAboutANameOfAHundredThousandTakesSeconds) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write(
        "s.json", R"({"tessera": 1, "include": [{"file": "builtin:room"}], "materials": [)" +
                      listOf(100'000, [](int i) { return fmt::format(R"({{"name":"m{}","model":"lambert"}})", i); }) +
                      R"(], "overrides": [{"node": "*", "material": ")" + std::string(100'000, 'm') + "\"}]}");
    EXPECT_LT(
        secondsOf([&] { EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }), HasSubstr("more")); }),
        kSeconds);
}

TEST(Growth, polygonsThatTakeLongToCutAreCutAsIfConvex) {
    // All corners but one lie in one cell of the grid, where each is looked at for each ear.
    constexpr int kCorners = 40'000;
    std::string text = "v 1e6 1e6 0\n", face = "f 1";
    for (int i = 0; i < kCorners; ++i) {
        text += fmt::format("v {} {} 0\n", i % 2, 1e-3 * (i + 1));
        face += fmt::format(" {}", i + 2);
    }
    const TempFolder folder;
    const std::filesystem::path file = folder.write("m.obj", text + face + "\n");
    EXPECT_LT(secondsOf([&] {
                  const Scene scene = underLedger(importObj, file);
                  EXPECT_EQ(scene.meshes.at(0).indices.size(), 3u * (kCorners - 1));
                  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("take too long to cut into triangles")));
              }),
              kSeconds);
}

/// glTF nodes, every other one with a camera, all of one name.
double secondsOfNodes(int count) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write(
        "m.gltf",
        R"({"asset":{"version":"2.0"},"cameras":[{"name":"c","type":"perspective","perspective":{"yfov":1,"znear":1}}],"nodes":[)" +
            listOf(count, [](int i) { return std::string(i % 2 == 0 ? "{}" : R"({"camera":0})"); }) + "]}");
    return secondsOf([&] { EXPECT_EQ(underLedger(importGltf, file).nodes.size(), static_cast<std::size_t>(count)); });
}

TEST(Growth, aHundredThousandNodesAndCamerasOfAGltfFileTakeSeconds) {
    EXPECT_LT(secondsOfNodes(100'000), kSeconds);
}

/// glTF nodes that all show the one mesh.
double secondsOfNodesThatShow(const std::string& mesh, int count) {
    const TempFolder folder;
    const std::filesystem::path file =
        folder.write("m.gltf", R"({"asset":{"version":"2.0"},"meshes":[)" + mesh + R"(],"nodes":[)" +
                                   listOf(count, [](int) { return std::string(R"({"mesh":0})"); }) + "]}");
    return secondsOf([&] { EXPECT_EQ(underLedger(importGltf, file).nodes.size(), static_cast<std::size_t>(count)); });
}

TEST(Growth, eightyThousandNodesThatShowAMeshOfAsManyPrimitivesTakeSeconds) {
    constexpr int kCount = 80'000;
    const std::string points = listOf(kCount, [](int) { return std::string(R"({"attributes":{},"mode":0})"); });
    EXPECT_LT(secondsOfNodesThatShow(R"({"primitives":[)" + points + "]}", kCount), kSeconds);
}

TEST(Growth, aHundredThousandNodesThatShowAMeshOfMoreWeightsTakeSeconds) {
    const std::string zeros = listOf(500'000, [](int) { return std::string("0"); });
    EXPECT_LT(secondsOfNodesThatShow(R"({"primitives":[],"weights":[)" + zeros + "]}", 100'000), kSeconds);
}

TEST(Growth, aHundredThousandUnknownExtensionsOfAGltfFileTakeSeconds) {
    const TempFolder folder;
    const std::filesystem::path file =
        folder.write("m.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": [)" +
                                   listOf(100'000, [](int i) { return fmt::format("\"EXT_{}\"", i); }) + "]}");
    EXPECT_LT(secondsOf([&] { underLedger(importGltf, file); }), kSeconds);
}

TEST(GrowthSlow, aMillionNodesOfAGltfFileTakeSeconds) {
    EXPECT_LT(secondsOfNodes(1'000'000), kSeconds);
}

} // namespace
} // namespace tessera::scenes
