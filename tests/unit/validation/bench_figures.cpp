#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/unit/validation/Benches.h"
#include "validation/bench/BenchHtml.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchReport.h"
#include "validation/bench/Pareto.h"
#include "validation/bench/Recommend.h"
#include "validation/bench/ScalingFit.h"

namespace tessera::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ScalingFit, aPowerLawIsFoundWithItsExponentAndFactor) {
    const std::vector<double> x{16, 64, 256, 1024};
    std::vector<double> y;
    for (const double value : x) y.push_back(3.0 * std::pow(value, 0.75));
    const std::optional<PowerFit> fit = fitPower(x, y);
    ASSERT_TRUE(fit);
    // Rounding of a few logarithms.
    EXPECT_NEAR(fit->exponent, 0.75, 1e-12);
    EXPECT_NEAR(fit->factor, 3.0, 1e-12);
    EXPECT_NEAR(fit->r2, 1.0, 1e-12);
    EXPECT_NEAR(fit->mostOff, 0.0, 1e-12);
    EXPECT_EQ(fit->points, 4u);
}

TEST(ScalingFit, anOutlierLowersTheGoodnessOfFit) {
    // log y is 0, 1, 0 over x of one step each: the best line is flat at 1/3 and explains nothing.
    const std::vector<double> x{1.0, std::exp(1.0), std::exp(2.0)}, y{1.0, std::exp(1.0), 1.0};
    const std::optional<PowerFit> fit = fitPower(x, y);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, 0.0, 1e-12);
    EXPECT_NEAR(fit->r2, 0.0, 1e-12);
    EXPECT_NEAR(fit->mostOff, std::expm1(2.0 / 3.0), 1e-12);
}

TEST(ScalingFit, twoDifferentPlacesNeverMakeAFit) {
    EXPECT_FALSE(fitPower(std::vector<double>{1, 2, 2}, std::vector<double>{1, 2, 3}));
    EXPECT_FALSE(fitPower(std::vector<double>{0, 1, 2}, std::vector<double>{1, 2, 3})); // 0 has no logarithm
}

TEST(ScalingFit, curvesJoinEqualPointsOfDifferentGroupsOnly) {
    std::vector<BenchGroup> groups;
    for (const int lights : {400, 100, 1600}) {
        groups.push_back(madeUpGroup(
            lights, {madeUpResult("forward", lights * 0.1, 1e-9), madeUpResult("deferred", std::sqrt(lights), 1e-9)}));
    }
    const std::vector<ScalingCurve> curves = scalingCurves(groups);
    ASSERT_EQ(curves.size(), 2u); // pixels and evaluations are the same everywhere
    EXPECT_THAT(curves[0].x, ElementsAre(100, 400, 1600));
    EXPECT_EQ(curves[0].quantity, "lights");
    EXPECT_NEAR(curves[0].fit->exponent, 1.0, 1e-12);
    EXPECT_NEAR(curves[1].fit->exponent, 0.5, 1e-12);
}

TEST(ScalingFit, noExponentIsReportedForTimesThatFollowNoLine) {
    BenchRecord record;
    // log10 y is 0, 0.3, 0.1 over x of one step each: R^2 is 0.107. A line fits 10, 100, 1000.
    const double noisyMs[] = {1.0, 2.0, 1.26};
    for (int i = 0; i < 3; ++i) {
        const double ms = std::pow(10.0, i);
        record.groups.push_back(madeUpGroup(
            int(ms), {madeUpResult("forward", 10.0 * ms, 1e-9), madeUpResult("deferred", noisyMs[i], 1e-9)}));
    }
    record.isComplete = true;
    const std::string page = benchHtml(record, record.groups[0], {}).sections;
    EXPECT_THAT(page, HasSubstr(R"("growth":"1.00")"));
    EXPECT_THAT(page, HasSubstr(R"("growth":"no trend")"));
    EXPECT_THAT(page, HasSubstr("<span>no trend</span>"));
    const std::string table = benchTable(record);
    EXPECT_THAT(table, HasSubstr("forward, exact: time grows as lights^1.00"));
    EXPECT_THAT(table, HasSubstr("deferred, exact: no trend of time with lights at 64x32 (R2 0.1"));
}

TEST(BenchPageHead, anUnfinishedBenchNeverRecommendsWithoutReserve) {
    BenchRecord record;
    record.groups = {madeUpGroup(10, {madeUpResult("forward", 10, 1e-9)})};
    record.plannedPoints = 9;
    const std::string reserve = "Unfinished: 1 of 9 points are measured";
    EXPECT_THAT(benchReport(record, "").bench->answer, testing::StartsWith("<p class=\"unfinished"));
    EXPECT_THAT(benchReport(record, "").bench->answer, HasSubstr(reserve));
    EXPECT_THAT(benchTable(record), HasSubstr(reserve));
    EXPECT_THAT(unfinishedText(record), HasSubstr("change with the others. Resume it to finish."));
    record.shards = 2;
    EXPECT_THAT(unfinishedText(record), HasSubstr("Resume every shard until it is finished, then merge them."));
    EXPECT_THAT(benchReport(BenchRecord{}, "").bench->answer, HasSubstr("Unfinished"));
    record.isComplete = true;
    EXPECT_THAT(benchReport(record, "").bench->answer, Not(HasSubstr("nfinished")));
    EXPECT_THAT(benchTable(record), Not(HasSubstr("nfinished")));
}

TEST(BenchPageHead, tilesClaimNoMoreThanTheSentenceBelowThem) {
    BenchRecord record;
    record.isComplete = true;
    const auto tiles = [&](double deferredP95) {
        record.groups = {madeUpGroup(10, {madeUpResult("forward", 40, 1e-9), madeUpResult("deferred", 10, 1e-9)})};
        record.groups[0].results[1].times.cpuMs.p95 = deferredP95;
        return benchReport(record, "").bench->answer;
    };
    EXPECT_THAT(tiles(11.0), testing::AllOf(HasSubstr("<dt>Take</dt><dd>deferred"), HasSubstr("4.0&times;")));
    EXPECT_THAT(tiles(21.0), testing::AllOf(HasSubstr("<dt>Ahead</dt><dd>deferred"), HasSubstr("the machine was busy"),
                                            Not(HasSubstr("&times;<small>"))));
    // Times within each other's spread.
    record.groups = {madeUpGroup(10, {madeUpResult("forward", 32, 1e-9), madeUpResult("deferred", 30, 1e-9)})};
    EXPECT_THAT(benchReport(record, "").bench->answer, HasSubstr("<dd>1.0&times;<small>as fast as forward"));
}

TEST(Pareto, theFrontIsThePointsThatNoOtherDominates) {
    const BenchGroup group =
        madeUpGroup(10, {madeUpResult("a", 10, 1e-9), madeUpResult("b", 5, 1e-6), madeUpResult("c", 6, 1e-6),
                         madeUpResult("d", 10, 1e-9), madeUpResult("e", 1, {}), madeUpResult("f", 20, 1e-9)});
    using Mark = std::optional<bool>;
    EXPECT_THAT(paretoFront(group), ElementsAre(Mark(true), Mark(true), Mark(false), Mark(true), Mark(), Mark(false)));
}

TEST(Recommend, theFastestPointOfAcceptableErrorIsTaken) {
    const BenchGroup group =
        madeUpGroup(257, {madeUpResult("forward", 100, 1e-9), madeUpResult("deferred", 40, 1e-9),
                          madeUpResult("deferred", 30, 2e-5, "packed"), madeUpResult("forward_plus", 10, 0.5)});
    const std::optional<Recommendation> choice = recommendFor(group);
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->best, &group.results[2]);
    EXPECT_EQ(choice->exact, &group.results[1]);
    EXPECT_TRUE(choice->isAcceptable);
    const std::string text = recommendationText(group);
    EXPECT_THAT(text, HasSubstr("deferred, packed: 3.3x faster than forward at relMSE 2.0e-05"));
    EXPECT_THAT(text, HasSubstr("30 ms a frame, 90.0 times the lower bound."));
    EXPECT_THAT(text, HasSubstr("The most exact is deferred, exact: 2.5x faster"));
}

TEST(Recommend, ofTimesThatTheSpreadDoesNotDistinguishTheSmallerErrorIsTaken) {
    // Made-up spreads are a tenth: 32 and 30 ms lie within each other's, 34 and 30 ms do not.
    const BenchGroup near =
        madeUpGroup(257, {madeUpResult("forward", 100, 1e-9), madeUpResult("deferred", 30, 2e-5, "packed"),
                          madeUpResult("deferred", 32, 1e-9), madeUpResult("tiled_deferred", 31, 1e-6, "packed")});
    const std::optional<Recommendation> choice = recommendFor(near);
    EXPECT_EQ(choice->best, &near.results[2]);
    EXPECT_EQ(choice->asFast, &near.results[1]);
    EXPECT_EQ(choice->exact, nullptr);
    EXPECT_THAT(recommendationText(near),
                HasSubstr("take deferred, exact: 3.1x faster than forward at relMSE 1.0e-09"));
    EXPECT_THAT(recommendationText(near),
                HasSubstr("deferred, packed takes as long within the spread of the times, 30 ms,"
                          " at the larger relMSE 2.0e-05."));
    const BenchGroup apart =
        madeUpGroup(257, {madeUpResult("deferred", 30, 2e-5, "packed"), madeUpResult("deferred", 34, 1e-9)});
    EXPECT_EQ(recommendFor(apart)->best, &apart.results[0]);
    EXPECT_EQ(recommendFor(apart)->asFast, nullptr);
    // Errors within a factor of two count as equal, and then the faster one stays.
    const BenchGroup equal =
        madeUpGroup(257, {madeUpResult("forward", 31, 1e-9), madeUpResult("deferred", 30, 1.5e-9)});
    EXPECT_EQ(recommendFor(equal)->best, &equal.results[1]);
    // One noisy point alone never makes itself as fast as a steady one.
    EXPECT_FALSE(isAsFast({30.0, 30.1}, {40.0, 90.0}));
    EXPECT_TRUE(isAsFast({30.0, 45.0}, {40.0, 90.0}));
}

TEST(Recommend, noSpeedIsClaimedThatTheSpreadDoesNotShow) {
    // Made-up spreads are a tenth: 30 and 32 ms lie within each other's.
    const BenchGroup near = madeUpGroup(10, {madeUpResult("forward", 32, 1e-9), madeUpResult("deferred", 30, 1e-9)});
    EXPECT_THAT(recommendationText(near), HasSubstr("take deferred, exact: as fast as forward within the spread"));
    // Forward's wide spread makes it as fast as the packed one; the steady and exact point between them is as fast,
    // too.
    BenchGroup mixed = madeUpGroup(10, {madeUpResult("forward", 34, 1e-9), madeUpResult("forward_plus", 32, 1e-9),
                                        madeUpResult("deferred", 30, 2e-5, "packed")});
    mixed.results[0].times.cpuMs.p95 = 60.0;
    mixed.results[1].times.cpuMs.p95 = 32.1;
    mixed.results[2].times.cpuMs.p95 = 36.0;
    const std::optional<Recommendation> choice = recommendFor(mixed);
    EXPECT_EQ(choice->best, &mixed.results[1]);
    EXPECT_EQ(choice->exact, nullptr);
}

TEST(Recommend, disturbedTimesAreReportedSo) {
    BenchGroup group = madeUpGroup(10, {madeUpResult("forward", 40, 1e-9), madeUpResult("deferred", 10, 1e-9)});
    EXPECT_THAT(recommendationText(group), testing::StartsWith("For "));
    EXPECT_TRUE(recommendFor(group)->recommends(group.results[1]));
    EXPECT_FALSE(recommendFor(group)->recommends(group.results[0]));
    group.results[1].times.cpuMs.p95 = 21.0;
    EXPECT_FALSE(recommendFor(group)->recommends(group.results[1]));
    EXPECT_THAT(recommendationText(group), testing::StartsWith("The machine was too busy to decide"));
    group.results[1].ratioToFloor = 0.5;
    EXPECT_THAT(recommendationText(group), HasSubstr("No frame can be faster than its lower bound"));
}

TEST(Recommend, noTechniqueIsRecommendedWhereThereIsNothingToCull) {
    BenchGroup group = madeUpGroup(0, {madeUpResult("forward", 40, 1e-9), madeUpResult("tiled_deferred", 10, 1e-9)});
    group.scene = "models/some place/Fox.glb";
    EXPECT_THAT(recommendationText(group),
                testing::AllOf(testing::StartsWith("In Fox.glb with "), HasSubstr("there is nothing to cull"),
                               Not(HasSubstr("take "))));
}

TEST(Recommend, aGroupWithoutAnAcceptablePointIsReportedSo) {
    const BenchGroup group = madeUpGroup(10, {madeUpResult("forward", 10, 0.2), madeUpResult("deferred", 5, 0.9)});
    EXPECT_EQ(recommendFor(group)->best, &group.results[0]);
    EXPECT_THAT(recommendationText(group), HasSubstr("Nothing here stays below relMSE 0.0001"));
    EXPECT_FALSE(recommendFor(madeUpGroup(10, {})));
    EXPECT_EQ(recommendationText(madeUpGroup(10, {})), "");
}

TEST(Recommend, anUnmeasuredErrorIsNotPraised) {
    const BenchGroup group = madeUpGroup(10, {madeUpResult("forward", 10, {}), madeUpResult("deferred", 5, {})});
    EXPECT_EQ(recommendFor(group)->best, &group.results[1]);
    EXPECT_THAT(recommendationText(group), Not(HasSubstr("relMSE")));
}

TEST(BenchJson, aGroupComesBackFromItsJsonDigitForDigit) {
    BenchGroup group = madeUpGroup(
        257, {madeUpResult("forward", 100.0 / 3.0, 1e-9), madeUpResult("tiled_deferred", 1e-3 / 3.0, {}, "packed")});
    group.results[1].key.culling = "tile_2.5d";
    group.results[1].key.tilePixels = 16;
    group.results[1].key.rangeTolerance = 0.1;
    group.results[1].key.method(MethodKind::Shadows) =
        MethodKey{"pcf", {{"shadowWidth", "5"}, {"shadowBudget", "0.1"}}};
    group.results[1].builder = "cpu";
    group.results[1].normalTest = "where_worth";
    group.pictures = {{"forward, exact", {"forward, exact"}, "a.png", "b.png", 0xfedcba9876543210ull}};
    const nlohmann::ordered_json json = groupJson(group);
    const BenchGroup back = groupFromJson(nlohmann::ordered_json::parse(json.dump()));
    EXPECT_EQ(groupJson(back), json);
    EXPECT_EQ(back.results[1].key, group.results[1].key);
    EXPECT_EQ(back.results[1].builder, "cpu");
    EXPECT_EQ(back.results[1].normalTest, "where_worth");
    EXPECT_EQ(back.results[0].times.cpuMs.median, 100.0 / 3.0);
    EXPECT_EQ(back.pictures[0].hash, 0xfedcba9876543210ull);
    EXPECT_EQ(back.lowerBound.stores[0].nsPerPair, 1.0 / 7.0);
    EXPECT_EQ(back.lowerBound.stores[0].nsPerPairP95, 1.0 / 6.0);
    EXPECT_EQ(back.lowerBound.geometryMsP95, 0.3);
    EXPECT_EQ(back.lowerBound.rounds, 5);
    EXPECT_EQ(back.results[0].floorLitMs, 1.0 / 6.0);
}

TEST(BenchJson, everyNullOfAPointHasItsReason) {
    const BenchGroup group = madeUpGroup(10, {madeUpResult("forward", 10, {}), madeUpResult("deferred", 5, 1e-9)});
    const nlohmann::ordered_json json = groupJson(group);
    for (const nlohmann::ordered_json& point : json["points"]) {
        for (const auto& [name, value] : point.items())
            EXPECT_TRUE(!value.is_null() || point["why"].contains(name)) << name;
    }
}

TEST(BenchCsv, everyPointIsOneLineOfAsManyFields) {
    BenchRecord record;
    record.groups = {madeUpGroup(10, {madeUpResult("forward", 10, {}), madeUpResult("deferred", 5, 1e-9)})};
    record.groups[0].scene = "my \"own\", scene.json";
    const std::string csv = benchCsv(record);
    EXPECT_THAT(csv,
                HasSubstr("\r\n\"my \"\"own\"\", scene.json\",forward,none,,,,,exact,0,,,,,,,,,,,,,,,,10,64,32,10,"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    EXPECT_EQ(commas(csv.substr(0, csv.find('\r'))) + 1, // one within the quoted name
              commas(csv.substr(csv.rfind("\"my"), csv.rfind('\r') - csv.rfind("\"my"))));
}

} // namespace
} // namespace tessera::validation
