#include <gtest/gtest.h>

#include "viewer/session/Timings.h"

namespace tessera::viewer {
namespace {

FrameTimes frame(std::uint64_t number, int side, double ms) {
    return {number, 0.0, ms, 1.0, side, {{"lighting", ms / 2.0, 0.25}, {"display", std::nullopt, 0.5}}};
}

TEST(Timings, aHistoryIsOfOneSide) {
    Timings timings;
    timings.add(frame(1, 0, 10.0));
    timings.add(frame(1, 1, 20.0));
    timings.add(frame(2, 0, 30.0));
    EXPECT_EQ(timings.frameMs(0), (std::vector<float>{10.0f, 30.0f}));
    EXPECT_EQ(timings.passMs(1, "lighting"), (std::vector<float>{10.0f}));
    EXPECT_EQ(timings.latest(0)->number, 2u);
    EXPECT_EQ(timings.latest(2), nullptr);
}

TEST(Timings, aPassWithoutATimeOfTheGpuShowsThatOfTheCpu) {
    Timings timings;
    timings.add(frame(1, 0, 10.0));
    EXPECT_EQ(timings.passMs(0, "display"), (std::vector<float>{0.5f}));
}

TEST(Timings, whatIsTypicalAreTheMediansOfFramesLikeTheLatest) {
    Timings timings;
    EXPECT_FALSE(timings.typical(0));
    FrameTimes first = frame(1, 0, 900.0); // includes compiling its shaders
    first.isUnlike = true;
    timings.add(first);
    ASSERT_TRUE(timings.typical(0));
    EXPECT_EQ(timings.typical(0)->ms, 900.0) << "there is no other";
    for (const double ms : {10.0, 90.0, 20.0}) timings.add(frame(2, 0, ms));
    timings.add(frame(2, 1, 5.0));
    FrameTimes other = frame(3, 0, 1.0);
    other.scale = 0.5;
    timings.add(other);
    other.scale = 1.0;
    other.kind = 7;
    timings.add(other);
    EXPECT_EQ(timings.typical(0)->ms, 1.0);
    EXPECT_EQ(timings.typical(0)->frames, 1u);
    timings.add(frame(4, 0, 30.0));
    const TypicalTimes typical = timings.typical(0).value();
    EXPECT_EQ(typical.frames, 4u);
    EXPECT_EQ(typical.ms, 25.0);
    ASSERT_EQ(typical.passes.size(), 2u);
    EXPECT_EQ(typical.passes[0].gpuMs, 12.5);
    EXPECT_EQ(typical.passes[1].gpuMs, std::nullopt);
    EXPECT_EQ(typical.passes[1].cpuMs, 0.5);
}

TEST(Timings, runsOfAPassAreSummedBeforeTheMedian) {
    Timings timings;
    for (const double ms : {2.0, 4.0, 6.0}) {
        FrameTimes frame;
        frame.passes = {{"blur", ms, 0.0}, {"blur", ms, 0.0}};
        timings.add(frame);
    }
    ASSERT_EQ(timings.typical(0)->passes.size(), 1u);
    EXPECT_EQ(timings.typical(0)->passes[0].gpuMs, 8.0);
}

TEST(Timings, picturesASecondAreThoseThatFollowOneAnotherWhileSomethingMoves) {
    Timings timings;
    const auto draw = [&](double startedMs, bool isPassing) {
        FrameTimes drawn = frame(1, 0, 10.0);
        drawn.startedMs = startedMs;
        drawn.isPassing = isPassing;
        timings.add(drawn);
        drawn.side = 1; // of the same image
        timings.add(drawn);
        return timings.picturesPerSecond();
    };
    EXPECT_FALSE(timings.picturesPerSecond());
    draw(0.0, true);
    draw(10.0, true);
    EXPECT_EQ(draw(20.0, true), 100.0);
    EXPECT_FALSE(draw(120.0, false)) << "the whole picture, at rest";
    EXPECT_FALSE(draw(5000.0, true));
    for (int i = 1; i <= 100; ++i) draw(5000.0 + 40.0 * i, true);
    EXPECT_EQ(timings.picturesPerSecond(), 25.0);
    draw(9500.0, true); // static in between
    EXPECT_FALSE(draw(9520.0, true));
}

TEST(Timings, theOldestFramesLeave) {
    Timings timings;
    for (std::uint64_t i = 1; i <= 1000; ++i) timings.add(frame(i, 0, double(i)));
    EXPECT_LE(timings.frames().size(), 240u);
    EXPECT_EQ(timings.frames().back().number, 1000u);
}

} // namespace
} // namespace tessera::viewer
