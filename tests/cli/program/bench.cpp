#include <cmath>
#include <map>
#include <set>

#include "tests/cli/program/Cli.h"
#include "tests/support/Sweep.h"

namespace tessera::test {
namespace {

using Json = nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;

class Bench : public Cli {
protected:
    /// Against the reference, and in a whole sweep against forward too.
    void expectShadowFiltersMeasured();
};
using BenchSlow = Bench;

TEST_F(Bench, everyPointIsMeasuredCountedAndComparedWithTheLowerBound) {
    folder_.write("matrix.json", R"({"technique": ["forward", "tiled_deferred", "clustered_deferred"],
                                     "culling": ["none", "tile_minmax", "cluster"], "tile": [16, 32], "lights": [0, 40]})");
    const std::string said = runGood(
        {"bench", "lattice", "--size", "96x54", "--frames", "2", "--matrix", "matrix.json", "-o", "out/of/bench"});
    EXPECT_THAT(said, HasSubstr("tile_minmax, 16"));
    EXPECT_THAT(said, HasSubstr("skipped forward, cluster"));
    const Json record = json("out/of/bench/bench.json");
    EXPECT_EQ(record["schema"], 9);
    EXPECT_EQ(record["complete"], true);
    EXPECT_FALSE(record["machine"].get<std::string>().empty());
    EXPECT_FALSE(record["commit"].get<std::string>().empty());
    // With lights: forward once, the others without culling and with one method at two tile sizes. Without lights
    // nothing is culled, and each technique has one frame.
    ASSERT_EQ(record["points"].size(), 3u + (1u + 3u + 3u));
    EXPECT_THAT(said, HasSubstr("it is the same frame as tiled_deferred, exact"));
    // Two frames on a machine that is busy elsewhere may be too noisy for a recommendation.
    EXPECT_THAT(record["recommendation"].get<std::string>(),
                AnyOf(HasSubstr("with 40 lights at 96x54 take "), HasSubstr("The machine was too busy to decide")));
    EXPECT_THAT(text("out/of/bench/bench.csv"), HasSubstr("\r\nlattice,clustered_deferred,cluster,32,"));
    for (const Json& bound : record["floors"]) {
        EXPECT_EQ(bound["rounds"], 5) << "two frames of each point were requested";
        EXPECT_GE(bound["geometryMsP95"], bound["geometryMs"]);
    }
    for (const Json& point : record["points"]) {
        SCOPED_TRACE(point.dump());
        EXPECT_GT(point["cpuMs"]["median"], 0.0);
        EXPECT_GE(point["cpuMs"]["p95"], point["cpuMs"]["median"]);
        EXPECT_EQ(point["counters"]["falseNegatives"], 0);
        for (const auto& [name, value] : point.items()) EXPECT_TRUE(!value.is_null() || point["why"].contains(name));
        if (point["lights"] == 0) {
            EXPECT_EQ(point["counters"]["lightEvaluations"], 0);
            EXPECT_EQ(point["counters"]["listBytes"], 0);
            continue;
        }
        EXPECT_GT(point["counters"]["lightEvaluations"], point["counters"]["neededEvaluations"]);
        EXPECT_GT(point["floorMs"], 0.0);
        // Some lights in range are behind the surfaces, so the lower bound of lit pairs is less.
        EXPECT_GT(point["counters"]["neededLitEvaluations"], 0);
        EXPECT_LT(point["counters"]["neededLitEvaluations"], point["counters"]["neededEvaluations"]);
        EXPECT_GT(point["floorLitMs"], 0.0);
        EXPECT_LT(point["floorLitMs"], point["floorMs"]);
        EXPECT_GT(point["ratioToLitFloor"], point["ratioToFloor"]);
        EXPECT_GE(point["counters"]["tightness"], 1.0);
        // Tolerance of fp32 and an exact layout against the reference in scenes without textures.
        EXPECT_EQ(point["against"], "reference");
        EXPECT_LE(point["error"]["relMse"], 1e-8);
        EXPECT_LE(std::abs(point["error"]["bias"].get<double>()), 1e-4);
        EXPECT_TRUE(point["pareto"].is_boolean());
    }
}

TEST_F(Bench, everyCauseOfErrorIsReported) {
    folder_.write("m.json", R"({"technique": ["deferred"], "layout": ["exact", "packed"], "range": [0, 0.05]})");
    runGood({"bench", "room", "--size", "64x36", "--frames", "1", "--matrix", "m.json", "--against", "forward", "-o",
             "out"});
    const Json record = json("out/bench.json");
    ASSERT_EQ(record["points"].size(), 2u); // a range tolerance affects no light of this scene
    EXPECT_EQ(record["points"][0]["error"]["relMse"], 0.0);
    EXPECT_GT(record["points"][1]["error"]["relMse"], 1e-9);
    EXPECT_EQ(record["points"][0]["against"], "forward");
    EXPECT_THAT(record["attribution"].dump(), HasSubstr("packed: albedo"));
    writeQuad(
        R"({"name": "paint", "model": "lambert", "k_d": [1, 1, 1]})",
        R"([{"type": "point", "position": [0, 0, 1], "falloff": {"type": "attenuation", "A": 0, "B": 0, "C": 1}}])");
    runGood({"bench", "quad.json", "--size", "64x36", "--frames", "1", "--matrix", "m.json", "-o", "out"});
    const Json ended = json("out/bench.json");
    ASSERT_EQ(ended["points"].size(), 4u);
    EXPECT_LT(ended["points"][0]["error"]["relMse"], ended["points"][1]["error"]["relMse"]);
    EXPECT_LT(ended["points"][1]["error"]["bias"], 0.0);
    EXPECT_THAT(ended["attribution"].dump(), HasSubstr("range tolerance 0.05"));
}

void Bench::expectShadowFiltersMeasured() {
    folder_.write("m.json", R"({"technique": ["forward"], "shadow": ["none", "traced", "hard"]})");
    const auto points = [&](const Words& more) {
        Words words{"bench", "head", "--size", "64x36", "--frames", "1", "--matrix", "m.json", "-o", "out"};
        words.insert(words.end(), more.begin(), more.end());
        runGood(words);
        return json("out/bench.json");
    };
    for (const char* truth : everyNth(std::vector{"reference", "forward"}, 2)) {
        SCOPED_TRACE(truth);
        const Json record = points({"--shadows", "all", "--against", truth});
        ASSERT_EQ(record["points"].size(), 3u);
        const double none = record["points"][0]["error"]["relMse"], traced = record["points"][1]["error"]["relMse"],
                     hard = record["points"][2]["error"]["relMse"];
        EXPECT_EQ(record["points"][0]["shadow"], "none");
        // Outlines of hard shadows are a texel off, and without shadows half of the bust is wrong.
        EXPECT_LT(traced, 1e-5);
        EXPECT_GT(hard, 10.0 * traced);
        EXPECT_GT(none, hard);
        std::map<std::string, double> causes;
        for (const Json& line : record["attribution"])
            if (line["cause"] == "shadow") causes[line["what"]] = line["relMse"];
        ASSERT_EQ(causes.size(), 2u) << "traced shadows of lights without a size are exact";
        // Beside rounding, the error of hard shadows is that of their filter.
        EXPECT_NEAR(causes["shadow filter hard"] / hard, 1.0, 0.1);
        EXPECT_NEAR(causes["no shadows"] / none, 1.0, 0.1);
    }
    const Json unshadowed = points({"--shadows", "none"});
    ASSERT_EQ(unshadowed["points"].size(), 1u) << "then the truth has none either";
    EXPECT_TRUE(unshadowed["points"][0]["shadow"].is_null());
    EXPECT_LT(unshadowed["points"][0]["error"]["relMse"], 1e-5);
}
TEST_F(Bench, shadowFiltersAreMeasuredAgainstTracedShadows) {
    expectShadowFiltersMeasured();
}
TEST_F(BenchSlow, shadowFiltersAreMeasuredAgainstTracedShadows) {
    expectShadowFiltersMeasured();
}

TEST_F(Bench, methodsOfSubsurfaceScatteringAreMeasuredAgainstTheSurfaceIntegral) {
    folder_.write("m.json", R"({"technique": ["forward"], "diffusionTexels": [64, 256],
                                "subsurface": ["none", "texture_space_diffusion"]})");
    runGood({"bench", "diffusion_truth", "--size", "32x18", "--frames", "1", "--matrix", "m.json", "--against",
             "reference", "-o", "out"});
    const Json record = json("out/bench.json");
    ASSERT_EQ(record["points"].size(), 3u);
    const auto relMse = [&](int i) { return record["points"][std::size_t(i)]["error"]["relMse"].get<double>(); };
    EXPECT_EQ(record["points"][0]["subsurface"], "none");
    EXPECT_TRUE(record["points"][0]["diffusionTexels"].is_null());
    EXPECT_EQ(record["points"][1]["diffusionTexels"], 64);
    EXPECT_EQ(record["points"][1]["diffusionHalf"], false);
    EXPECT_EQ(record["points"][2]["diffusionTexels"], 256);
    EXPECT_GT(relMse(0), 5.0 * relMse(2));
    std::set<std::string> passes; // diffused again in each frame, else the second frame would lack these passes
    for (const Json& pass : record["points"][2]["passes"]) passes.insert(pass["name"]);
    EXPECT_THAT(passes, testing::Contains("diffusion_light"));
    std::map<std::string, double> causes;
    for (const Json& line : record["attribution"])
        if (line["cause"] == "subsurface") causes[line["what"]] = line["relMse"];
    EXPECT_EQ(causes.size(), 3u);
    EXPECT_NEAR(causes["no subsurface"] / relMse(0), 1.0, 1e-3);
}

TEST_F(Bench, waysToFindTheEnvironmentsLightAreMeasuredAgainstTheIntegral) {
    folder_.write("m.json", R"({"technique": ["forward"], "environmentSamples": [4, 256],
                                "environmentLight": ["off", "split_sum", "sampled"]})");
    runGood({"bench", "spheres", "--environment", "studio", "--size", "64x36", "--frames", "1", "--matrix", "m.json",
             "--against", "reference", "-o", "out"});
    const Json record = json("out/bench.json");
    ASSERT_EQ(record["points"].size(), 4u);
    std::map<std::string, double> relMse;
    for (const Json& point : record["points"]) {
        const std::string samples = point["environmentSamples"].is_null() ? "" : point["environmentSamples"].dump();
        relMse[point["environmentLight"].get<std::string>() + samples] = point["error"]["relMse"];
    }
    // Four samples are noisy. 64 times as many have a 64th of the squared noise, beside that of the reference.
    EXPECT_GT(relMse["sampled4"], 10.0 * relMse["sampled256"]);
    EXPECT_GT(relMse["off"], 2.0 * relMse["split_sum"]);
    std::map<std::string, double> causes;
    for (const Json& line : record["attribution"])
        if (line["cause"] == "environment") causes[line["what"]] = line["relMse"];
    EXPECT_EQ(causes.size(), 4u);
    EXPECT_NEAR(causes["no environment light"] / relMse["off"], 1.0, 1e-2);
}

TEST_F(Bench, theNoiseOfSoftShadowsIsAnError) {
    folder_.write("m.json", R"({"technique": ["forward"], "shadowSamples": [1, 64]})");
    runGood({"bench", "shadow_truth", "--size", "64x36", "--frames", "1", "--matrix", "m.json", "-o", "out"});
    const Json record = json("out/bench.json");
    ASSERT_EQ(record["points"].size(), 2u);
    EXPECT_EQ(record["points"][0]["shadowSamples"], 1);
    // The error of a visible fraction is 30 times as large with one sample (docs/shadows.md).
    EXPECT_GT(record["points"][0]["error"]["relMse"], 100.0 * record["points"][1]["error"]["relMse"].get<double>());
    EXPECT_THAT(record["attribution"].dump(), HasSubstr("shadow filter traced, samples 1"));
}

TEST_F(Bench, unlitAndTransparentSurfacesAreCountedAsSuch) {
    folder_.write("m.json", R"({"technique": ["deferred_volumes", "tiled_deferred"]})");
    const auto counters = [&](const std::string& material) {
        writeQuad(material,
                  R"([{"type": "point", "position": [0, 0, 1], "falloff": {"type": "inverse_square", "range": 4}},
                                {"type": "directional", "direction": [0, 0, -1]}])");
        runGood({"bench", "quad.json", "--size", "64x64", "--frames", "1", "--matrix", "m.json", "-o", "out"});
        Json points = json("out/bench.json")["points"];
        for (const Json& point : points)
            for (const auto& [name, value] : point["counters"].items())
                EXPECT_TRUE(!value.is_null() || point["why"].contains(name)) << name;
        return points;
    };
    for (const Json& point : counters(R"({"name": "paint", "model": "single_color"})")) {
        EXPECT_EQ(point["counters"]["lightEvaluations"], 0) << point["technique"];
        EXPECT_EQ(point["counters"]["neededEvaluations"], 0) << point["technique"];
    }
    for (const Json& point :
         counters(R"({"name": "paint", "model": "lambert", "k_d": [1, 1, 1, 0.5], "alphaMode": "blend"})")) {
        EXPECT_TRUE(point["counters"]["neededEvaluations"].is_null());
        EXPECT_TRUE(point["floorMs"].is_null());
        EXPECT_TRUE(point["floorLitMs"].is_null());
    }
    expectError(2, {"bench", "room", "-o", "none", "--technique", "forward", "--samples", "4"}, {"--samples"});
}

TEST_F(Bench, aBadMatrixIsRefusedInOneLineThatNamesIt) {
    const auto refused = [&](const std::string& matrix) {
        folder_.write("m.json", matrix);
        const ProcessResult result = run({"bench", "lattice", "--size", "32x18", "--matrix", "m.json", "-o", "out"});
        EXPECT_EQ(result.exitCode, 2) << matrix;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr("m.json"));
        return result.err;
    };
    EXPECT_THAT(refused("{"), HasSubstr("m.json:1:2: "));
    EXPECT_THAT(refused("{\n  \"tile\": [8,]\n}"), HasSubstr("m.json:2:14: "));
    EXPECT_THAT(refused(R"({"tile": [8], "lights": [4], "tile": [16]})"), HasSubstr("'tile' is given twice; keep one"));
    EXPECT_THAT(refused("[]"), HasSubstr("object of arrays"));
    EXPECT_THAT(refused(R"({"tiles": [16]})"), HasSubstr("did you mean 'tile'"));
    EXPECT_THAT(refused(R"({"tile": [17]})"), HasSubstr("8, 16, 32, 64"));
    EXPECT_THAT(refused(R"({"technique": ["forward+"]})"), HasSubstr("forward"));
    EXPECT_THAT(refused(R"({"lights": [262145]})"), HasSubstr("262144"));
    EXPECT_THAT(refused(R"({"size": ["0x10"]})"), HasSubstr("1280x720"));
    EXPECT_THAT(refused(R"({"technique": []})"), HasSubstr("at least one"));
    EXPECT_THAT(refused(R"({"range": [-1]})"), HasSubstr("range tolerance"));
    EXPECT_THAT(refused(R"({"shadow": ["pfc"]})"), HasSubstr("did you mean 'pcf'"));
    EXPECT_THAT(refused(R"({"shadowWidth": [2]})"), HasSubstr("1, 3, 5, 7"));
    EXPECT_THAT(refused(R"({"subsurface": ["depth_maps"]})"), HasSubstr("did you mean 'depth_map'"));
    EXPECT_THAT(refused(R"({"diffusionTexels": [100]})"), HasSubstr("64, 128"));
    EXPECT_THAT(refused(R"({"diffusionHalf": [2]})"), HasSubstr("neither true nor false"));
    EXPECT_THAT(refused(R"({"environmentLight": ["splitsum"]})"), HasSubstr("did you mean 'split_sum'"));
}

TEST_F(Bench, aViewIsNotTakenForTheLitPicture) {
    for (const char* view : {"normal", "lights", "gbuffer.albedo"})
        expectError(2, {"bench", "room", "-o", "out", "--view", view},
                    {std::string("--view ") + view, "leave --view out", "tessera render"});
}

} // namespace
} // namespace tessera::test
