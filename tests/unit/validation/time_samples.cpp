#include "validation/timing/TimeSamples.h"

#include <cmath>

#include <gtest/gtest.h>

#include "validation/timing/FrameTimer.h"

namespace tessera::validation {
namespace {

TEST(TimeSamples, medianAndP95AreMeasuredTimes) {
    std::vector<double> samples;
    for (int i = 20; i > 0; --i) samples.push_back(i);
    const TimeSpread spread = spreadOf(samples);
    EXPECT_EQ(spread.median, 10.0);
    EXPECT_EQ(spread.p95, 19.0);
}

TEST(TimeSamples, noSamplesNeverGiveANumber) {
    EXPECT_TRUE(std::isnan(spreadOf({}).median));
    EXPECT_TRUE(std::isnan(spreadOf({}).p95));
    EXPECT_TRUE(std::isnan(slopeSpread({}, {}, 1.0).median));
}

TEST(TimeSamples, theSlopeIsExactlyTheMedianOverRoundsWhateverTheMachinesPace) {
    // Rounds at paces 1, 2 and 10, the last one as if another program had run: 3 per unit at pace 1.
    const std::vector<double> low{5.0, 10.0, 50.0}, high{5.0 + 12.0, 10.0 + 24.0, 50.0 + 120.0};
    EXPECT_EQ(slopeSpread(low, high, 4.0).median, 6.0);
    EXPECT_EQ(slopeSpread(high, low, 4.0).median, -6.0);
}

TEST(SummarisePasses, passesThatSumToTheirFrameAreKept) {
    PointTimes times;
    // 15 % of 10 ms may be missing.
    summarisePasses(times, {"a", "b"}, {{{3.0}, {5.6}}, {{4.0}, {5.5}}, {{3.5}, {5.4}}},
                    std::vector<double>{10.0, 10.0, 10.0});
    ASSERT_EQ(times.passes.size(), 2u);
    EXPECT_EQ(times.passes[0].name, "a");
    EXPECT_EQ(times.passes[0].gpuMs, 3.5);
    EXPECT_EQ(times.passes[1].gpuMs, 5.5);
    EXPECT_EQ(times.gpuMs.value().median, 8.9);
    EXPECT_TRUE(times.why.empty());
}

TEST(SummarisePasses, passesThatDoNotSumToTheirFrameAreNullWithAReason) {
    PointTimes times;
    summarisePasses(times, {"a", "b"}, {{{3.0}, {5.0}}}, std::vector<double>{10.0});
    ASSERT_EQ(times.passes.size(), 2u);
    EXPECT_FALSE(times.passes[0].gpuMs);
    EXPECT_FALSE(times.gpuMs);
    EXPECT_EQ(times.why.at("passes.gpuMs"),
              "the passes sum to 8 ms of the 10 ms of their frames, beyond the 15 % that may be missing");
    EXPECT_EQ(times.why.at("gpuMs"), times.why.at("passes.gpuMs"));
}

TEST(SummarisePasses, aPassWithoutATimeIsNamed) {
    PointTimes times;
    summarisePasses(times, {"a", "b"}, {{{3.0}, {5.0}}, {{3.0}, {}}}, {});
    EXPECT_FALSE(times.passes[0].gpuMs);
    EXPECT_EQ(times.why.at("gpuMs"), "the driver gave no time for pass 'b'");
    summarisePasses(times, {}, {}, {});
    EXPECT_EQ(times.why.at("gpuMs"), "no frame was profiled");
}

TEST(SummarisePasses, timersOfTheGpuNeverNeedToSumToTheFrame) {
    PointTimes times;
    summarisePasses(times, {"a"}, {{{3.0}}}, {});
    EXPECT_EQ(times.passes[0].gpuMs, 3.0);
    EXPECT_TRUE(times.why.empty());
}

} // namespace
} // namespace tessera::validation
