#include "validation/compare/CompareRecord.h"

#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "tests/unit/validation/Samples.h"
#include "validation/figures/FigureText.h"

namespace tessera::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

CompareRecord sampleRecord() {
    const Picture b = greyPicture(4, 1, 1.f);
    Picture a = b;
    setPixel(a, 2, {1.5f, 1.f, 1.f});
    CompareRecord record{"hall", 4, 1, "llvmpipe", {}};
    record.pairs.push_back(comparePair("deferred", b, "forward", b, {.bitEqual = 1.0}));
    record.pairs.push_back(comparePair("packed", a, "forward", b, {.maxRel = 0.25, .relMse = 1e-4}));
    return record;
}

std::vector<std::string> keys(const Json& object) {
    std::vector<std::string> names;
    for (const auto& [name, value] : object.items()) names.push_back(name);
    return names;
}

TEST(CompareRecord, jsonHasExactlyTheAgreedFields) {
    const Json json = Json::parse(compareJson(sampleRecord()));
    EXPECT_THAT(keys(json), ElementsAre("schema", "scene", "size", "samples", "renderer", "pairs", "left_out"));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["scene"], "hall");
    EXPECT_EQ(json["size"], Json::parse("[4, 1]"));
    EXPECT_EQ(json["renderer"], "llvmpipe");
    ASSERT_EQ(json["pairs"].size(), 2u);
    for (const Json& pair : json["pairs"]) {
        EXPECT_THAT(keys(pair), ElementsAre("a", "b", "maxAbs", "maxRel", "rmse", "relMse", "p50Rel", "p99Rel",
                                            "p999Rel", "bias", "biasNoise", "bitEqual", "flip", "psnr", "nan", "inf",
                                            "negative", "excluded", "litShare", "litCovered", "meanLuminance",
                                            "tolerance", "ok", "missed", "culling", "why"));
        EXPECT_THAT(keys(pair["tolerance"]),
                    ElementsAre("maxRel", "bitEqual", "relMse", "p999Rel", "bias", "biasNoises"));
    }
}

TEST(CompareRecord, lostGeometryIsNamedAndLetsNoPairHold) {
    CompareRecord record = sampleRecord();
    EXPECT_FALSE(Json::parse(compareJson(record)).contains("lost")) << "nothing was compared with the reference";
    record.excludesPixels = true;
    EXPECT_EQ(Json::parse(compareJson(record))["lost"], Json::array());
    record.lost = {{LostKind::Missing, 12, "coat", "ball", 103, 80, 45}, {LostKind::Transparent, {}, "", "", 1, 2, 3}};
    EXPECT_TRUE(record.pairs[0].verdict.ok);
    missLostGeometry(record.pairs[0].verdict, record.lost);
    EXPECT_FALSE(record.pairs[0].verdict.ok);
    const std::string sentence = "instance 12 (node 'coat', mesh 'ball') is missing from 103 pixels, such as 80,45";
    EXPECT_THAT(record.pairs[0].verdict.missed, ElementsAre("geometry: " + sentence + "; and 1 more"));
    const std::string table = compareTable(record);
    EXPECT_THAT(table, HasSubstr("\ngeometry: " + sentence + "\n"));
    EXPECT_THAT(table, HasSubstr("\ngeometry: a transparent surface differs from the reference, or another "
                                 "transparent one before or behind it, in 1 pixel, such as 2,3\n"));
    const Json lost = Json::parse(compareJson(record))["lost"];
    EXPECT_EQ(lost[0], Json::parse(R"({"what": "missing", "instance": 12, "node": "coat", "mesh": "ball", "pixels": 103,
                                       "pixel": [80, 45], "why": {}})"));
    EXPECT_TRUE(lost[1]["instance"].is_null());
    EXPECT_TRUE(lost[1]["why"].contains("instance"));
}

TEST(CompareRecord, jsonHoldsTheFiguresWithEveryDigit) {
    const CompareRecord record = sampleRecord();
    const Json pair = Json::parse(compareJson(record))["pairs"][1];
    EXPECT_EQ(pair["a"], "packed");
    EXPECT_EQ(pair["b"], "forward");
    EXPECT_EQ(pair["maxAbs"].get<double>(), 0.5);
    EXPECT_EQ(pair["rmse"].get<double>(), record.pairs[1].figures.rmse);
    EXPECT_EQ(pair["relMse"].get<double>(), record.pairs[1].figures.relMse);
    EXPECT_EQ(pair["bitEqual"].get<double>(), 0.75);
    EXPECT_EQ(pair["tolerance"]["maxRel"].get<double>(), 0.25);
    EXPECT_TRUE(pair["tolerance"]["bias"].is_null());
    EXPECT_FALSE(pair["ok"].get<bool>());
    EXPECT_EQ(pair["missed"][0], "maxRel is 0.5, at most 0.25 is required");
    EXPECT_EQ(pair["nan"], 0);
}

TEST(CompareRecord, aPairIsOkOnlyIfItIsJudged) {
    const Picture grey = greyPicture(2, 1, 1.f);
    CompareRecord record{"x", 2, 1, "r", {}};
    record.pairs.push_back(comparePair("a", grey, "b", grey, {.reason = "maps approximate"}));
    record.pairs.push_back(comparePair("a", grey, "b", grey, {.maxRel = 0.0}));
    record.pairs.push_back(comparePair("a", greyPicture(2, 1, std::nanf("")), "b", grey, {}));
    const Json pairs = Json::parse(compareJson(record))["pairs"];
    EXPECT_TRUE(pairs[0]["ok"].is_null());
    EXPECT_EQ(pairs[0]["why"]["ok"], "not judged: maps approximate");
    EXPECT_EQ(pairs[1]["ok"], true);
    EXPECT_EQ(pairs[2]["ok"], false) << "no picture may hold a NaN";
}

TEST(CompareRecord, everyNullFigureHasAReason) {
    CompareRecord record{"x", 2, 1, "r", {}};
    Picture broken = greyPicture(2, 1, std::nanf(""));
    Picture none = greyPicture(2, 1, 1.f);
    none.covered = {0, 0};
    const Picture black = greyPicture(2, 1, 0.f);
    for (const Picture& picture : {broken, none, black, greyPicture(2, 1, 1.f)})
        record.pairs.push_back(comparePair("a", picture, "b", picture, {}));
    const Json json = Json::parse(compareJson(record));
    for (const Json& pair : json["pairs"])
        for (const auto& [name, value] : pair.items()) {
            if (value.is_null()) {
                EXPECT_FALSE(pair["why"].value(name, "").empty()) << name << " is null without a reason";
            }
        }
    EXPECT_TRUE(json["pairs"][0]["maxRel"].is_null());
    EXPECT_EQ(json["pairs"][0]["nan"], 2);
    EXPECT_EQ(json["pairs"][0]["why"]["maxRel"], "no covered pixel is finite");
    EXPECT_EQ(json["pairs"][1]["why"]["bitEqual"], "no pixel is covered");
    EXPECT_THAT(keys(json["pairs"][3]["why"]), ElementsAre("psnr", "ok", "culling"));
}

TEST(CompareRecord, aNameThatIsNotUtf8NeverKeepsTheRecordFromBeingWritten) {
    CompareRecord record = sampleRecord();
    record.scene = "sc\xff"
                   "ne.gltf";
    EXPECT_TRUE(Json::accept(compareJson(record)));
}

TEST(CompareRecord, aRecordIsOkExactlyWhenItHasPairsAndAllHold) {
    CompareRecord record = sampleRecord();
    EXPECT_FALSE(record.ok());
    record.pairs.pop_back();
    EXPECT_TRUE(record.ok());
    record.pairs.clear();
    EXPECT_FALSE(record.ok());
}

TEST(CompareRecord, theTableShowsEveryPairAndItsMissedTolerances) {
    EXPECT_EQ(compareTable(sampleRecord()),
              "hall  4x1  llvmpipe\n"
              "pair                 bit-equal  max rel  p99.9 rel   relMSE     bias  FLIP   PSNR    lit  verdict\n"
              "deferred vs forward      100 %        0          0        0        0     0  equal  100 %  ok\n"
              "packed vs forward     75.000 %  5.0e-01    5.0e-01  2.1e-02  2.7e-02     0  equal  100 %  MISSED\n"
              "missed: packed vs forward: maxRel is 0.5, at most 0.25 is required\n"
              "missed: packed vs forward: relMse is 0.0206270627, at most 0.0001 is required\n");
}

TEST(CompareRecord, theFractionOfExcludedPixelsIsReported) {
    const Picture a = greyPicture(4, 1, 2.f);
    const std::vector<std::uint8_t> excluded{0, 1, 0, 0};
    CompareRecord record{"hall", 4, 1, "llvmpipe", {comparePair("forward", a, "reference", a, {}, excluded)}};
    EXPECT_THAT(compareTable(record), testing::Not(testing::HasSubstr("excluded:")));
    record.excludesPixels = true;
    EXPECT_THAT(compareTable(record),
                testing::HasSubstr("excluded: 25.000 % of the covered pixels, where rounding moves an edge\n"));
    record.pairs = {comparePair("forward", a, "reference", a, {})};
    EXPECT_THAT(compareTable(record), testing::HasSubstr("excluded: 0 % of"));
}

TEST(CompareRecord, theErrorOfARangeToleranceIsReportedWhereOneIsSet) {
    const Picture whole = greyPicture(4, 1, 2.f);
    Picture cut = whole;
    setPixel(cut, 2, {1.f, 1.f, 1.f});
    CompareRecord record = sampleRecord();
    EXPECT_FALSE(Json::parse(compareJson(record)).contains("rangeTruncation"));
    record.rangeTruncation = {0.25, "forward", errorFigures(cut, whole)};
    const Json dropped = Json::parse(compareJson(record))["rangeTruncation"];
    EXPECT_THAT(keys(dropped), ElementsAre("tolerance", "technique", "bias", "relMse", "p99Rel", "why"));
    EXPECT_EQ(dropped["tolerance"], 0.25);
    EXPECT_EQ(dropped["technique"], "forward");
    EXPECT_EQ(dropped["bias"], -0.125); // one pixel of four loses half
    EXPECT_EQ(dropped["relMse"].get<double>(), record.rangeTruncation->figures.relMse);
    EXPECT_EQ(dropped["p99Rel"], 0.5);
    EXPECT_TRUE(dropped["why"].empty());
    EXPECT_THAT(compareTable(record), testing::EndsWith("dropped by the range tolerance 0.25: bias -1.2e-01, relMSE "
                                                        "6.2e-02, p99 rel 5.0e-01 (forward against itself without "
                                                        "it)\n"));
    const Picture black = greyPicture(4, 1, 0.f);
    record.rangeTruncation->figures = errorFigures(black, black);
    const Json nothing = Json::parse(compareJson(record))["rangeTruncation"];
    EXPECT_TRUE(nothing["bias"].is_null());
    EXPECT_FALSE(nothing["why"]["bias"].get<std::string>().empty());
}

TEST(CompareRecord, reportsTheFiguresOfTheReferenceForDiffusedLight) {
    CompareRecord record = sampleRecord();
    EXPECT_FALSE(Json::parse(compareJson(record)).contains("spreadLight"));
    EXPECT_THAT(compareTable(record), testing::Not(HasSubstr("diffused light")));
    record.diffusedLight = {7, 1.25, 0.125};
    const Json json = Json::parse(compareJson(record))["spreadLight"];
    EXPECT_THAT(keys(json), ElementsAre("pixels", "integral", "facingAway"));
    EXPECT_EQ(json["integral"], 1.25);
    EXPECT_THAT(compareTable(record),
                HasSubstr("diffused light: in 7 pixels; the profile's integral over the surface, by "
                          "which the reference divides, is 1.25 on average; 12.500 % of it"));
}

TEST(CompareRecord, picturesOfTwoSizesAreRefused) {
    EXPECT_THROW(comparePair("a", greyPicture(1, 1, 1), "b", greyPicture(2, 1, 1), {}), InputError);
}

TEST(FigureText, aShareReadsHundredPercentExactlyWhenItIs) {
    EXPECT_EQ(shareText(1.0), "100 %");
    EXPECT_EQ(shareText(0.999999999), "99.999 %");
    EXPECT_EQ(shareText(1e-9), "0.001 %");
    EXPECT_EQ(shareText(0.0), "0 %");
    EXPECT_EQ(shareText(0.5), "50.000 %");
    EXPECT_EQ(figureText(std::nan("")), "-");
    EXPECT_EQ(figureText(0.0), "0");
    EXPECT_EQ(figureText(-1.25e-7), "-1.2e-07");
    EXPECT_EQ(decibelText(std::nullopt), "-");
    EXPECT_EQ(decibelText(40.04), "40.0 dB");
}

TEST(CompareRecord, reportsNoiseAndOfUndecidedPixelsOfShadows) {
    const Picture a = greyPicture(2, 1, 1.f);
    CompareRecord record{"hall", 2, 1, "llvmpipe", {comparePair("forward", a, "reference", a, {})}};
    EXPECT_EQ(compareTable(record).find("shadows:"), std::string::npos);
    EXPECT_FALSE(Json::parse(compareJson(record))["pairs"][0].contains("shadows"));
    ShadowFigures right;
    right.undecided = 0.049;
    right.noisyPixels = 100;
    right.noise = 1.05;
    right.mostNoise = 1.1;
    right.bias = 2e-3;
    right.biasNoise = 3e-4;
    record.pairs[0].shadows = right;
    EXPECT_THAT(compareTable(record), HasSubstr("shadows: forward: 4.9"));
    EXPECT_EQ(Json::parse(compareJson(record))["pairs"][0]["shadows"]["noisyPixels"], 100);
    EXPECT_THAT(missedByShadows(right), IsEmpty());
    ShadowFigures far = right;
    far.undecided = 0.2;
    EXPECT_THAT(missedByShadows(far, "light 3 'sun'"), ElementsAre(HasSubstr("digits, farthest light 3 'sun'")));
    const auto missedWith = [&](double ShadowFigures::*figure, double value) {
        ShadowFigures wrong = right;
        wrong.*figure = value;
        return missedByShadows(wrong).size();
    };
    EXPECT_EQ(missedWith(&ShadowFigures::undecided, 0.051), 1u);
    EXPECT_EQ(missedWith(&ShadowFigures::noise, 1.11), 1u);
    EXPECT_EQ(missedWith(&ShadowFigures::noise, std::nan("")), 1u);
    EXPECT_EQ(missedWith(&ShadowFigures::bias, -2.6e-3), 1u);
    // Without a tolerance for the other errors neither noise nor bias is judged.
    right.mostNoise.reset();
    EXPECT_EQ(missedWith(&ShadowFigures::undecided, 0.051), 1u);
    EXPECT_EQ(missedWith(&ShadowFigures::noise, 11.8), 0u);
    EXPECT_EQ(missedWith(&ShadowFigures::bias, -0.1), 0u);
    record.pairs[0].shadows = right;
    EXPECT_THAT(compareTable(record), HasSubstr("independent rays (other errors included, so not judged)"));
    EXPECT_TRUE(Json::parse(compareJson(record))["pairs"][0]["shadows"]["mostNoise"].is_null());
}

} // namespace
} // namespace tessera::validation
