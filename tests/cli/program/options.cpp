#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/PictureFile.h"
#include "tests/cli/program/Cli.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::test {
namespace {

constexpr const char* kGlossy =
    R"({"name": "paint", "model": "metallic_roughness", "baseColor": [0.6, 0.3, 0.1], "metallic": 0.5,
        "perceptualRoughness": 0.4})";
constexpr const char* kTwoLights = R"([{"type": "point", "position": [1, 0, 1], "intensity": 3},
                                       {"type": "point", "position": [-1, 0.5, 1], "intensity": 2}])";

/// The effect of each frame option, on a square lit by two lights.
class FrameOptions : public Cli {
protected:
    void SetUp() override { writeQuad(kGlossy, kTwoLights); }

    std::string rendered(const Words& more, const std::string& extension = ".exr", const char* scene = "quad.json") {
        const std::string name = fmt::format("{}{}", ++made_, extension);
        Words words{"render", scene, "--size", "48x27", "-o", name};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(runGood(words), "");
        return name;
    }
    Picture pictureOf(const Words& more, const char* scene = "quad.json") {
        return picture(rendered(more, ".exr", scene));
    }
    std::string pngOf(const Words& more) { return text(rendered(more, ".png")); }

    static double mean(const Picture& picture) {
        double sum = 0.0;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i)
            for (std::size_t c = 0; c < 3; ++c) sum += double(picture.pixel(i)[c]);
        return sum / double(3 * picture.pixelCount());
    }

private:
    int made_ = 0;
};

TEST_F(FrameOptions, exposureMultipliesTheDisplayPictureByTwoToItsPower) {
    writeQuad(R"({"name": "paint", "model": "single_color", "color": [0.25, 0.125, 0.03125]})", "[]");
    const auto red = [&](const char* exposureEV) {
        return picture(rendered({"--exposure", exposureEV}, ".png")).pixel(0)[0];
    };
    const float step = 0.005f; // one step of 8-bit sRGB near 1/2
    EXPECT_NEAR(red("0"), 0.25f, step);
    EXPECT_NEAR(red("1"), 0.5f, step);
    EXPECT_NEAR(red("-1"), 0.125f, step);
    EXPECT_EQ(red("9"), 1.0f);
    EXPECT_EQ(pictureOf({"--exposure", "1"}).pixel(0)[0], 0.25f) << "radiance is before exposure";
}

/// The lights fall to 0.5 at 4 m and at 2 m from themselves; the square is 1 m away.
constexpr const char* kTwoAttenuated = R"([
    {"type": "point", "position": [1, 0, 1], "intensity": 8, "falloff": {"type": "attenuation", "C": 0.5, "A": 8}},
    {"type": "point", "position": [-1, 0.5, 1], "intensity": 2, "falloff": {"type": "attenuation", "C": 1}}])";

TEST_F(FrameOptions, aRangeToleranceDropsLightAndPlanAndCompareReportHowMuch) {
    writeQuad(kGlossy, kTwoAttenuated);
    const Picture whole = pictureOf({}), cut = pictureOf({"--range-tolerance", "0.5"});
    EXPECT_LT(mean(cut), mean(whole));
    EXPECT_EQ(pictureOf({"--range-tolerance", "0"}).rgba, whole.rgba) << "0 is the default";

    EXPECT_THAT(runGood({"plan", "quad.json", "--range-tolerance", "0.5", "--json", "p.json"}),
                testing::AllOf(testing::HasSubstr("range tolerance"), testing::HasSubstr("2 lights")));
    const auto choice = [&](const char* what) {
        const nlohmann::json plan = json("p.json");
        for (const nlohmann::json& one : plan["choices"])
            if (one["what"] == what) return one;
        return nlohmann::json();
    };
    EXPECT_EQ(choice("range tolerance")["chosen"], "0.5");
    EXPECT_EQ(choice("range tolerance")["why"],
              "2 lights with falloff by A B C or from an area made finite, radii 2 m to 4 m");
    EXPECT_TRUE(choice("light that the range tolerance drops").is_null()) << "not measured";
    runGood({"plan", "quad.json", "--range-tolerance", "0.5", "--measure", "--size", "48x27", "--json", "p.json"});
    EXPECT_THAT(choice("light that the range tolerance drops")["chosen"].get<std::string>(),
                testing::StartsWith("bias -"));

    const std::string table = runGood({"compare", "quad.json", "--size", "48x27", "--range-tolerance", "0.5",
                                       "--techniques", "tiled_deferred", "--json", "c.json"});
    EXPECT_THAT(table, testing::HasSubstr("dropped by the range tolerance 0.5: bias -"));
    const nlohmann::json record = json("c.json");
    EXPECT_EQ(record["pairs"][0]["ok"], true) << "each technique drops the same";
    const nlohmann::json& dropped = record["rangeTruncation"];
    EXPECT_EQ(dropped["tolerance"], 0.5);
    EXPECT_EQ(dropped["technique"], "forward");
    EXPECT_GT(dropped["relMse"], 0.0);
    EXPECT_GT(dropped["p99Rel"], 0.0);
    const validation::ErrorFigures figures = validation::errorFigures(cut, whole);
    // Those images are files, whose coverage is their alpha; forward and deferred agree to the last bit.
    EXPECT_DOUBLE_EQ(dropped["bias"].get<double>(), figures.bias);
    EXPECT_DOUBLE_EQ(dropped["relMse"].get<double>(), figures.relMse);

    runGood({"compare", "quad.json", "--size", "48x27", "--json", "c.json"});
    EXPECT_FALSE(json("c.json").contains("rangeTruncation"));
    rendered({"--range-tolerance", "0.5"}, ".exr");
    runGood({"compare", "quad.json", "--size", "48x27", "--range-tolerance", "0.5", "--techniques", "deferred",
             "--against", "4.exr", "--json", "c.json"});
    EXPECT_EQ(json("c.json")["rangeTruncation"]["technique"], "deferred") << "a picture has no other tolerance";
}

TEST_F(FrameOptions, everyToneMapShowsTheSceneItsOwnWay) {
    std::set<std::string> shown;
    for (const char* name : {"none", "khronos_neutral", "aces", "agx"})
        shown.insert(pngOf({"--exposure", "1", "--tonemap", name}));
    EXPECT_EQ(shown.size(), 4u);
    EXPECT_TRUE(shown.contains(pngOf({"--exposure", "1"}))) << "none is the default";
}

TEST_F(FrameOptions, everyViewIsExactlyTheSameByNumberAndByName) {
    const char* names[] = {"diffuse", "normal_texel", "normal", "distribution", "geometry", "fresnel", "final"};
    std::set<std::string> shown;
    for (int key = 1; key <= 7; ++key) {
        SCOPED_TRACE(key);
        const std::string byName = pngOf({"--view", names[key - 1]});
        EXPECT_TRUE(byName == pngOf({"--view", std::to_string(key)}));
        shown.insert(byName);
    }
    EXPECT_EQ(shown.size(), 7u) << "two views show the same";
    EXPECT_TRUE(shown.contains(pngOf({}))) << "final is the default";
}

TEST_F(FrameOptions, pruneOffNeverChangesABit) {
    EXPECT_TRUE(text(rendered({"--prune", "off"})) == text(rendered({})));
    EXPECT_TRUE(text(rendered({"--prune", "off", "--technique", "forward"})) == text(rendered({"--prune", "on"})));
}

TEST_F(FrameOptions, everyTechniqueIsExactlyTheSameWithTheExactLayoutAndNearWithThePackedOne) {
    const std::string deferred = text(rendered({}));
    for (const char* technique : {"forward", "forward_prepass", "deferred"})
        EXPECT_TRUE(text(rendered({"--technique", technique, "--layout", "exact"})) == deferred) << technique;
    const std::string packed = rendered({"--layout", "packed"});
    EXPECT_FALSE(text(packed) == deferred);
    EXPECT_LE(validation::errorFigures(picture(packed), pictureOf({})).relMse, 1e-4) << "the layout's promise";
}

TEST_F(FrameOptions, lightingInViewSpaceGivesThePictureOfWorldSpace) {
    // Only rounding differs: fp32 against double is at 1e-10 already.
    EXPECT_LE(validation::errorFigures(pictureOf({"--space", "view"}), pictureOf({"--space", "world"})).relMse, 1e-9);
}

TEST_F(FrameOptions, specularOffLeavesOnlyTheDiffuseLobe) {
    const double with = mean(pictureOf({})), without = mean(pictureOf({"--specular", "off"}));
    EXPECT_LT(without, 0.95 * with);
    EXPECT_GT(without, 0.0);
    // A Lambert square has no specular lobe.
    writeQuad(R"({"name": "paint", "model": "lambert"})", kTwoLights);
    EXPECT_TRUE(text(rendered({"--specular", "off"})) == text(rendered({"--specular", "on"})));
}

TEST_F(FrameOptions, theLightsAloneAddUpToTheWhole) {
    const Picture first = pictureOf({"--solo", "0"}), second = pictureOf({"--solo", "1"}), both = pictureOf({});
    for (std::size_t i = 0; i < both.pixelCount(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const float sum = first.pixel(i)[c] + second.pixel(i)[c];
            ASSERT_GT(first.pixel(i)[c], 0.0f);
            ASSERT_NEAR(sum, both.pixel(i)[c], 1e-6f * sum); // rounding of a few additions
        }
    }
}

TEST_F(FrameOptions, lightsKeepsTheFirstOfAFileAndCountsThoseOfABuiltinScene) {
    EXPECT_TRUE(text(rendered({"--lights", "1"})) == text(rendered({"--solo", "0"})));
    EXPECT_EQ(mean(pictureOf({"--lights", "0"})), 0.0);
    runGood({"plan", "lattice", "--lights", "37", "--json", "p.json"});
    EXPECT_EQ(json("p.json")["counters"]["lights"], 37);
}

TEST_F(FrameOptions, noDefaultLightLeavesASceneWithoutLightsDark) {
    writeQuad(kGlossy, "[]");
    const Words render{"render", "quad.json", "--size", "48x27", "-o", "lit.exr"};
    const ProcessResult lit = run(render);
    EXPECT_EQ(lit.exitCode, 0);
    EXPECT_THAT(lit.out, testing::HasSubstr("lit by the environment 'studio'"));
    EXPECT_GT(mean(picture("lit.exr")), 0.0);
    EXPECT_EQ(mean(pictureOf({"--no-default-light"})), 0.0);
}

TEST_F(FrameOptions, theBackgroundIsTheRadianceThatIsGivenWhereNothingIsDrawn) {
    writeQuad(kGlossy, "[]");
    for (const char* technique : {"forward", "clustered_deferred", "reference"}) {
        const Picture seen =
            pictureOf({"--no-default-light", "--background", "0.25,2,0.5", "--fov", "150", "--technique", technique});
        std::size_t behind = 0;
        for (std::size_t i = 0; i < seen.pixelCount(); ++i) {
            if (seen.covered[i]) continue;
            ++behind;
            ASSERT_EQ(glm::vec3(seen.pixel(i)[0], seen.pixel(i)[1], seen.pixel(i)[2]), glm::vec3(0.25f, 2.0f, 0.5f))
                << technique;
        }
        EXPECT_GT(behind, 0u) << technique;
    }
}

TEST_F(FrameOptions, filterExactInterpolatesInSinglePrecision) {
    DisplayImage texture{2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0}};
    writePng(path("t.png"), texture);
    writeQuad(R"({"name": "paint", "model": "single_color", "color": {"texture": "t.png"}})", "[]");
    const Picture exact = pictureOf({"--filter", "exact"}), hardware = pictureOf({"--filter", "hardware"});
    EXPECT_TRUE(hardware.rgba == pictureOf({}).rgba) << "hardware is the default";
    // Hardware interpolates with 8-bit weights and texels: a difference of a few of 256 steps between black and white.
    double largest = 0.0;
    for (std::size_t i = 0; i < exact.pixelCount(); ++i)
        largest = std::max(largest, std::abs(double(exact.pixel(i)[0]) - double(hardware.pixel(i)[0])));
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(largest, 4.0 / 256.0);
}

TEST_F(FrameOptions, samplesSoftenEdgesAndOneChangesNothing) {
    const Words lattice{"--technique", "forward", "--lights", "4", "--view", "diffuse"};
    const auto latticeWith = [&](const char* samples) {
        Words words = lattice;
        words.insert(words.end(), {"--samples", samples});
        return pictureOf(words, "lattice");
    };
    const Picture one = pictureOf(lattice, "lattice"), four = latticeWith("4");
    EXPECT_TRUE(latticeWith("1").rgba == one.rgba);
    EXPECT_GT(validation::errorFigures(four, one).rmse, 0.0);
    // Edge pixels average their neighbours. Nearly all of the 1296 pixels lie on an edge, and with one sample each is
    // wrong by half its contrast of about 1: 0.5 / sqrt(1296) is 1.4 %, and three times that is rare.
    EXPECT_NEAR(mean(four), mean(one), 0.042 * mean(one));
    // Pixels that a surface only touches are covered too.
    EXPECT_GT(std::count(four.covered.begin(), four.covered.end(), 1),
              std::count(one.covered.begin(), one.covered.end(), 1));
}

TEST_F(FrameOptions, cameraChoosesTheView) {
    runGood({"render", "room", "--size", "48x27", "-o", "first.exr"}); // prints the names of the others
    EXPECT_TRUE(text(rendered({"--camera", "corner"}, ".exr", "room")) == text("first.exr"));
    EXPECT_FALSE(text(rendered({"--camera", "back"}, ".exr", "room")) == text("first.exr"));
}

} // namespace
} // namespace tessera::test
