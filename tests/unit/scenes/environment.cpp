#include "scenes/Environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <numbers>

#include <sys/stat.h>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/PictureBytes.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes {
namespace {

using namespace test;

TEST(Environment, directionsAndPlacesOfAMapAgreeAndItsMiddleLooksAlongMinusZ) {
    const auto expectPlace = [](const glm::dvec3& direction, double x, double y) {
        const glm::dvec2 place = placeInMap(direction);
        EXPECT_NEAR(place.x, x, 1e-12);
        EXPECT_NEAR(place.y, y, 1e-12);
    };
    expectPlace({0, 0, -1}, 0.5, 0.5);
    expectPlace({1, 0, 0}, 0.75, 0.5); // to the right when looking along -z
    expectPlace({-1, 0, 0}, 0.25, 0.5);
    EXPECT_EQ(placeInMap({0, 1, 0}).y, 0.0); // the pole lies anywhere along the row
    for (int i = 1; i < 20; ++i) {
        const glm::dvec2 place(i / 20.0, std::fmod(i * 0.37, 1.0));
        expectPlace(directionInMap(place), place.x, place.y);
    }
}

TEST(Environment, numbersThatAreNoLightAreReplacedAndCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const struct {
        int width;
        std::vector<float> rgb, kept;
        std::vector<std::string> warnings; ///< after the environment's name
    } cases[] = {{2,
                  {nan, -1.0f, 3.0f, infinite, 0.5f, -0.0f},
                  {0.0f, 0.0f, 3.0f, 1.0f, 3.0f, 0.5f, 0.0f, 1.0f},
                  {"holds NaN in 1 number, taken as 0", "is below 0 in 1 number, taken as 0",
                   "holds infinity in 1 number, taken as its brightest"}},
                 {2,
                  {1e30f, 2e30f, 3e38f, infinite, 0.0f, 0.0f},
                  {1e30f, 1e30f, 1e30f, 1.0f, 1e30f, 0.0f, 0.0f, 1.0f},
                  {"holds infinity in 1 number, taken as its brightest", "is above 1e+30 in 2 numbers, taken as that"}},
                 // One texel, which may have any aspect ratio. Without a finite maximum, infinity becomes 1.
                 {1,
                  {nan, -infinite, infinite},
                  {0.0f, 0.0f, 1.0f, 1.0f},
                  {"holds NaN in 1 number, taken as 0", "is below 0 in 1 number, taken as 0",
                   "holds infinity in 1 number, taken as its brightest"}},
                 {1, {0.25f, 0.5f, 1e5f}, {0.25f, 0.5f, 1e5f, 1.0f}, {}}};
    const TempFolder folder;
    for (const auto& one : cases) {
        LoadLedger ledger;
        std::vector<std::string> warnings, expected;
        for (const std::string& warning : one.warnings) expected.push_back("the environment 'a.pfm' " + warning);
        const std::string file = folder.file("a.pfm", pfmOf(one.width, 1, one.rgb));
        EXPECT_EQ(storedTexels<float>(loadEnvironment(file, ledger, warnings).map), one.kept);
        EXPECT_EQ(warnings, expected);
    }
}

/// The total light of a map, by solid angle.
double lightOf(const Image& map) {
    const std::vector<float> numbers = storedTexels<float>(map);
    double sum = 0.0;
    for (int y = 0; y < map.height; ++y) {
        const double top = std::numbers::pi * y / map.height, bottom = std::numbers::pi * (y + 1) / map.height;
        for (int x = 0; x < map.width; ++x)
            sum += (std::cos(top) - std::cos(bottom)) * double(numbers[4 * std::size_t(y * map.width + x)]) / map.width;
    }
    return sum;
}

TEST(Environment, mapsOfMoreTexelsThanAreKeptAreAveragedWithoutLossOfLight) {
    TempFolder folder;
    // A sun of one texel, and a NaN that averaging would propagate.
    const auto write = [&](const std::string& name, int width, int height) {
        std::vector<float> rgb(std::size_t(3 * width * height), 0.125f);
        rgb[std::size_t(3 * (height / 3 * width + width / 5))] = 1e6f;
        rgb[4] = std::numeric_limits<float>::quiet_NaN();
        return folder.write(name, pfmOf(width, height, rgb));
    };
    struct Case {
        const char* name;
        int width, height, keptWidth, keptHeight;
        const char* size;
    };
    for (const Case& one : {Case{"wide.pfm", 16384, 4, 8192, 4, "512.0 KiB"},
                            {"odd.pfm", 9001, 3, 8192, 3, "384.0 KiB"},
                            {"high.pfm", 2, 5000, 2, 4096, "128.0 KiB"}}) {
        const std::string file = write(one.name, one.width, one.height).string();
        LoadLedger ledger;
        std::vector<std::string> warnings;
        const Image map = loadEnvironment(file, ledger, warnings).map;
        EXPECT_EQ(map.width, one.keptWidth);
        EXPECT_EQ(map.height, one.keptHeight);
        EXPECT_EQ(ledger.usedBytes(), map.texels.size()) << "the large one is gone";
        Image whole;
        whole.width = one.width;
        whole.height = one.height;
        std::vector<glm::vec4> texels(std::size_t(one.width * one.height), glm::vec4(0.125f));
        texels[std::size_t(one.height / 3 * one.width + one.width / 5)].r = 1e6f;
        whole.texels.resize(texels.size() * sizeof(glm::vec4));
        std::memcpy(whole.texels.data(), texels.data(), whole.texels.size());
        EXPECT_NEAR(lightOf(map), lightOf(whole), 1e-6 * lightOf(whole)) << one.name;
        ASSERT_EQ(warnings.size(), 3u) << "NaN, the shape and the size";
        EXPECT_EQ(warnings[2],
                  fmt::format("the environment '{}' has {}x{} texels; their averages in {}x{} are shown, {} of the GPU",
                              one.name, one.width, one.height, one.keptWidth, one.keptHeight, one.size));
        for (const float number : storedTexels<float>(map)) ASSERT_TRUE(std::isfinite(number));
    }
    EXPECT_EQ(kMostMapWidth, 2 * kMostMapHeight);
}

TEST(Environment, mapsThatAreNotTooLargeKeepTheirBits) {
    TempFolder folder;
    std::vector<float> rgb(std::size_t(3 * kMostMapWidth));
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = 0.1f * float(i);
    LoadLedger ledger;
    std::vector<std::string> warnings;
    const Image map = loadEnvironment(folder.file("most.pfm", pfmOf(kMostMapWidth, 1, rgb)), ledger, warnings).map;
    ASSERT_EQ(map.width, kMostMapWidth);
    const std::vector<float> numbers = storedTexels<float>(map);
    for (std::size_t i = 0; i < rgb.size(); ++i) ASSERT_EQ(numbers[i / 3 * 4 + i % 3], rgb[i]);
    EXPECT_EQ(warnings.size(), 1u) << "of its shape";
}

TEST(Environment, aMapIsNamedByASceneAndReplacedOrTakenAwayByWhoLoadsIt) {
    const SceneFolder folder;
    const auto file = folder.write("sky.pfm", pfmOf(4, 2, std::vector<float>(24, 2.0f)));
    const Scene scene =
        folder.import(R"({"tessera": 1, "environment": {"map": "sky.pfm", "intensity": 0.5, "rotationDegrees": 30}})");
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->map.width, 4);
    EXPECT_EQ(scene.environment->intensity, 0.5f);
    EXPECT_EQ(scene.environment->rotationDegrees, 30.0f);
    EXPECT_TRUE(scene.warnings.empty());
    const std::string saved = (folder.path() / "scene.json").string();
    LoadOptions options = loading(&LoadOptions::environment, "studio");
    const Environment studio = loadScene(saved, options).environment.value();
    EXPECT_EQ(studio.source, "builtin:studio");
    EXPECT_EQ(studio.rotationDegrees, 30.0f) << "it lies as the scene's own";
    EXPECT_EQ(studio.intensity, 1.0f) << "which is of the map";
    options.environment = file.string();
    EXPECT_EQ(loadScene(saved, options).environment.value().intensity, 0.5f) << "the scene's own map";
    options.environment = "none";
    EXPECT_FALSE(loadScene(saved, options).environment);
    options.environment = "stdio";
    EXPECT_EQ(inputErrorOf([&] { loadScene(saved, options); }),
              "no built-in environment or picture file is called 'stdio'; did you mean 'studio'?");
    // An environment counts as light, so no default light is supplied.
    options.environment = "sky";
    EXPECT_EQ(loadScene(saved, options).environment.value().source, "builtin:sky");
}

TEST(Environment, aNameIsThatOfABuiltInOneAsSceneFilesWriteItTooAndOfAFileAlone) {
    const SceneFolder folder;
    LoadLedger ledger;
    std::vector<std::string> warnings;
    EXPECT_EQ(environmentCalled("builtin:studio", ledger, warnings).value().source, "builtin:studio");
    const auto problem = [&](const std::string& name) {
        return inputErrorOf([&] { environmentCalled(name, ledger, warnings); });
    };
    EXPECT_EQ(problem("builtin:sea"), "there is no built-in environment 'sea'; valid are studio, sky");
    const std::string path = folder.path().string();
    EXPECT_EQ(problem(path), path + ": is a folder; give a picture file or a glTF model in it");
    const std::string pipe = (folder.path() / "pipe.hdr").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(problem(pipe), pipe + ": is not a regular file; name the picture itself"); // and does not block
    EXPECT_TRUE(problem(path + "/none.hdr").starts_with("no built-in environment or picture file is called '"));
}

TEST(Environment, aBlackMapIsReportedOnceAndNoOtherIs) {
    TempFolder folder;
    for (const float blue : {0.0f, 1e-30f}) { // of the last texel
        LoadLedger ledger;
        std::vector<std::string> warnings, expected;
        std::vector<float> rgb(24, 0.0f);
        rgb.back() = blue;
        loadEnvironment(folder.file("night.pfm", pfmOf(4, 2, rgb)), ledger, warnings);
        if (blue == 0.0f) expected = {"the environment 'night.pfm' is black everywhere and gives no light"};
        EXPECT_EQ(warnings, expected);
    }
}

TEST(Environment, aCallbackGetsTheComputedFractionOfABuiltInMap) {
    LoadLedger ledger;
    std::mutex mutex;
    std::vector<double> shares;
    ledger.reportEnvironment([&](double share) {
        const std::lock_guard lock(mutex);
        shares.push_back(share);
    });
    std::vector<std::string> warnings;
    const Environment studio = loadEnvironment("builtin:studio", ledger, warnings);
    std::ranges::sort(shares); // threads report in any order
    ASSERT_EQ(shares.size(), std::size_t(studio.map.height));
    EXPECT_EQ(shares.front(), 1.0 / studio.map.height);
    EXPECT_EQ(shares.back(), 1.0);
}

TEST(Environment, wrongOnesAreRefusedByName) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "environment": {"map": "builtin:sea"}})"),
              "/environment/map: there is no built-in environment 'sea'; valid are studio, sky");
    EXPECT_EQ(folder.errorBeyondSchemaOf(R"({"tessera": 1, "environment": {"intensity": 2}})"),
              "/environment: says how a map lies or shines, and there is none; name a 'map'");
    EXPECT_EQ(folder.errorOf(R"({"tessera": 1, "environment": {"intensity": -1}})"),
              "/environment/intensity: is -1; at least 0 is needed");
    folder.write("sky.pfm", pfmOf(2, 1, {1e20f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f}));
    const auto errorOf = [&](const std::string& how) {
        return folder.errorOf(R"({"tessera": 1, "environment": {"map": "sky.pfm", )" + how + "}}");
    };
    EXPECT_THAT(errorOf(R"("intensity": 1e39)"), HasSubstr("/environment/intensity: is 1e+39; at most 3.4"));
    EXPECT_THAT(errorOf(R"("rotationDegrees": -1e39)"), HasSubstr("/environment/rotationDegrees: is -1e+39; at least"));
    const std::string bright = folder.file("bright.json", R"({"tessera": 1, "environment": {"map": "sky.pfm", )"
                                                          R"("intensity": 1e11}})");
    EXPECT_EQ(inputErrorOf([&] { loadScene(bright); }),
              bright + ": scene 'bright': environment 0 'sky.pfm': its brightest texel times its intensity is 1e+31, "
                       "and at most 1e+30 can be shown; lower its intensity");
}

/// Irradiance of level ground divided by pi: the radiance of a white floor.
glm::dvec3 onGround(const Image& map) {
    const std::vector<float> texels = storedTexels<float>(map);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < map.height / 2; ++y)
        for (int x = 0; x < map.width; ++x) {
            const double fromTop = std::numbers::pi * (y + 0.5) / map.height;
            const double solidAngle =
                2.0 * std::numbers::pi / map.width * std::numbers::pi / map.height * std::sin(fromTop);
            const float* const texel = &texels[4 * std::size_t(y * map.width + x)];
            sum += solidAngle * std::cos(fromTop) * glm::dvec3(texel[0], texel[1], texel[2]);
        }
    return sum / std::numbers::pi;
}

TEST(Environment, builtInOnesLightAWhiteFloorAboutAsBrightAsWhite) {
    for (const BuiltinEnvironment& builtin : builtinEnvironments()) {
        const Image map = builtin.makeMap({});
        EXPECT_EQ(map.width, 2 * map.height);
        const glm::dvec3 white = onGround(map);
        EXPECT_GT(white.g, 0.5) << builtin.name;
        EXPECT_LT(white.g, 1.2) << builtin.name;
        for (const float value : storedTexels<float>(map))
            ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << builtin.name;
    }
}

} // namespace
} // namespace tessera::scenes
