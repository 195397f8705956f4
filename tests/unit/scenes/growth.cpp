#include <ctime>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/json/SceneFiles.h"
#include "tests/unit/scenes/obj/ObjFiles.h"

/// Loading time grows linearly with the size of the file.
namespace tessera::scenes {
namespace {

using namespace test;

/// Linear loading takes about a second for each file here; quadratic loading took minutes. The rest is a margin for
/// slower machines.
#ifdef __SANITIZE_ADDRESS__
constexpr double kSeconds = 100.0; // sanitizers take several times as long
#else
constexpr double kSeconds = 10.0;
#endif

constexpr const char* kMaterial = R"({{"name":"m{}","model":"lambert"}})";

class Growth : public testing::Test {
protected:
    /// Expects `action` to take at most kSeconds of CPU time, which excludes other programs.
    static void expectSeconds(const std::function<void()>& action) {
        const std::clock_t start = std::clock();
        action();
        EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, kSeconds);
    }
    /// Writes a scene of named triangles and of overrides that give matching ones a material.
    std::filesystem::path sceneOfNames(int count, const std::function<std::string(int)>& nameOf,
                                       const std::vector<std::string>& patterns) const {
        std::string text(kThreeVertices);
        for (int i = 0; i < count; ++i) text += "g " + nameOf(i) + "\nf 1 2 3\n";
        folder.write("m.obj", text);
        return folder.write("s.json", R"({"tessera": 1, "include": [{"file": "m.obj"}],
            "materials": [{"name": "own", "model": "lambert"}], "overrides": [)" +
                                          listOf(int(patterns.size()),
                                                 [&](int i) {
                                                     return fmt::format(R"({{"node":"{}","material":"own"}})",
                                                                        patterns[std::size_t(i)]);
                                                 }) +
                                          "]}");
    }
    /// Expects a glTF file of `count` nodes, after `members`, to load in time.
    void expectNodesInSeconds(const std::string& members, int count,
                              const std::function<std::string(int)>& node) const {
        const std::filesystem::path file = folder.write("m.gltf", R"({"asset":{"version":"2.0"},)" + members +
                                                                      R"(,"nodes":[)" + listOf(count, node) + "]}");
        expectSeconds([&] { EXPECT_EQ(underLedger(importGltf, file).nodes.size(), std::size_t(count)); });
    }
    /// Every other node has a camera; all cameras share a name.
    void expectCamerasInSeconds(int count) const {
        expectNodesInSeconds(R"("cameras":[{"name":"c","type":"perspective","perspective":{"yfov":1,"znear":1}}])",
                             count, [](int i) { return i % 2 == 0 ? "{}" : R"({"camera":0})"; });
    }
    /// All nodes show the same mesh.
    void expectShownInSeconds(const std::string& mesh, int count) const {
        expectNodesInSeconds(R"("meshes":[)" + mesh + "]", count, [](int) { return R"({"mesh":0})"; });
    }

    const TempFolder folder;
};
class GrowthSlow : public Growth {};

TEST_F(Growth, aHundredThousandMaterialsAndCamerasOfASceneFileTakeSeconds) {
    const std::filesystem::path file = folder.write(
        "s.json",
        R"({"tessera": 1, "materials": [)" +
            listOf(100'000, [](int i) { return fmt::format(fmt::runtime(kMaterial), i); }) + R"(], "cameras": [)" +
            listOf(100'000,
                   [](int i) { return fmt::format(R"({{"name":"c{}","position":[0,0,1],"target":[0,0,0]}})", i); }) +
            "]}");
    const auto load = [&] {
        const Scene scene = underLedger(importSceneJson, file);
        EXPECT_EQ(scene.materials.size(), 100'000u);
        EXPECT_EQ(scene.cameras.size(), 100'000u);
    };
    expectSeconds(load);
}

TEST_F(Growth, aHundredThousandMaterialsOfAnObjFileTakeSeconds) {
    std::string text(kThreeVertices);
    for (int i = 0; i < 100'000; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
    const std::filesystem::path file = folder.write("m.obj", text);
    expectSeconds([&] { EXPECT_EQ(underLedger(importObj, file).materials.size(), 100'000u); });
}

TEST_F(Growth, warningsAreNotMoreThanAHundredAndTheirRest) {
    std::string text(kThreeVertices);
    std::string library;
    for (int i = 0; i < 300; ++i) text += fmt::format("usemtl m{}\nf 1 2 3\n", i);
    for (int i = 0; i < 300; ++i) library += fmt::format("newmtl m{}\nd 0\n", i);
    folder.write("m.mtl", library);
    const Scene scene =
        loadScene(folder.file("m.obj", "mtllib m.mtl\n" + text), loading(&LoadOptions::defaultLight, false));
    ASSERT_EQ(scene.warnings.size(), 101u);
    EXPECT_EQ(scene.warnings[100], "and 200 more warnings");
}

TEST_F(Growth, thirtyThousandOverridesOfNodesAndMaterialsByNameTakeSeconds) {
    constexpr int kCount = 30'000;
    std::string text(kThreeVertices);
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
    expectSeconds([&] { EXPECT_EQ(underLedger(importSceneJson, named).materials.size(), kCount + 0u); });
    const std::filesystem::path patterns =
        sceneOf(listOf(2 * kCount, [](int) { return std::string(R"({"node":"n*","material":"own0"})"); }));
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, patterns); }),
                HasSubstr("/node: the overrides up to here take more than 1000000000 steps"));
}

TEST_F(Growth, fortyPatternsOverAHundredThousandNodesAreRead) {
    constexpr int kCount = 100'000;
    const auto nameOf = [](int i) { return fmt::format("hangar_7/wing_left/engine_2/turbine/blade_{:06}", i); };
    std::vector<std::string> patterns;
    for (int i = 0; i < 40; ++i) patterns.push_back(nameOf(i * 1000).substr(0, 45) + "*");
    const std::filesystem::path file = sceneOfNames(kCount, nameOf, patterns);
    expectSeconds([&] { EXPECT_GE(underLedger(importSceneJson, file).nodes.size(), kCount + 0u); });
}

TEST_F(Growth, patternsThatBeginAgainAtEveryCharacterAreRefused) {
    const std::filesystem::path file =
        sceneOfNames(2000, [](int i) { return std::string(4000, 'x') + std::to_string(i); },
                     {"*0", "*" + std::string(2000, 'x') + "y*"});
    expectSeconds([&] {
        EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }),
                    HasSubstr("/overrides/1/node: the overrides up to here take more than 1000000000 steps"));
    });
}

TEST_F(Growth, starsAtTheEndOfAPatternAreCounted) {
    const std::filesystem::path file = sceneOfNames(2000, [](int) { return "a"; }, {"a" + std::string(1'000'000, '*')});
    EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }),
                HasSubstr("/overrides/0/node: the overrides up to here take more than 1000000000 steps"));
}

TEST_F(Growth, anErrorAboutANameOfAHundredThousandTakesSeconds) {
    const std::filesystem::path file = folder.write(
        "s.json", R"({"tessera": 1, "include": [{"file": "builtin:room"}], "materials": [)" +
                      listOf(100'000, [](int i) { return fmt::format(fmt::runtime(kMaterial), i); }) +
                      R"(], "overrides": [{"node": "*", "material": ")" + std::string(100'000, 'm') + "\"}]}");
    expectSeconds([&] { EXPECT_THAT(inputErrorOf([&] { underLedger(importSceneJson, file); }), HasSubstr("more")); });
}

TEST_F(Growth, polygonsThatTakeLongToCutAreCutAsIfConvex) {
    // All corners but one lie in one cell of the grid, so every ear tests each of them.
    constexpr int kCorners = 40'000;
    std::string text = "v 1e6 1e6 0\n", face = "f 1";
    for (int i = 0; i < kCorners; ++i) {
        text += fmt::format("v {} {} 0\n", i % 2, 1e-3 * (i + 1));
        face += fmt::format(" {}", i + 2);
    }
    const std::filesystem::path file = folder.write("m.obj", text + face + "\n");
    expectSeconds([&] {
        const Scene scene = underLedger(importObj, file);
        EXPECT_EQ(scene.meshes.at(0).indices.size(), 3u * (kCorners - 1));
        EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("take too long to cut into triangles")));
    });
}

TEST_F(Growth, aHundredThousandNodesAndCamerasOfAGltfFileTakeSeconds) {
    expectCamerasInSeconds(100'000);
}

TEST_F(Growth, eightyThousandNodesThatShowAMeshOfAsManyPrimitivesTakeSeconds) {
    constexpr int kCount = 80'000;
    const std::string points = listOf(kCount, [](int) { return std::string(R"({"attributes":{},"mode":0})"); });
    expectShownInSeconds(R"({"primitives":[)" + points + "]}", kCount);
}

TEST_F(Growth, aHundredThousandNodesThatShowAMeshOfMoreWeightsTakeSeconds) {
    const std::string zeros = listOf(500'000, [](int) { return std::string("0"); });
    expectShownInSeconds(R"({"primitives":[],"weights":[)" + zeros + "]}", 100'000);
}

TEST_F(Growth, aHundredThousandUnknownExtensionsOfAGltfFileTakeSeconds) {
    const std::filesystem::path file =
        folder.write("m.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": [)" +
                                   listOf(100'000, [](int i) { return fmt::format("\"EXT_{}\"", i); }) + "]}");
    expectSeconds([&] { underLedger(importGltf, file); });
}

TEST_F(GrowthSlow, aMillionNodesOfAGltfFileTakeSeconds) {
    expectCamerasInSeconds(1'000'000);
}

} // namespace
} // namespace tessera::scenes
