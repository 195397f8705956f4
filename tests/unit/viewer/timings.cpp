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

TEST(Timings, theOldestFramesLeave) {
    Timings timings;
    for (std::uint64_t i = 1; i <= 1000; ++i) timings.add(frame(i, 0, double(i)));
    EXPECT_LE(timings.frames().size(), 240u);
    EXPECT_EQ(timings.frames().back().number, 1000u);
}

} // namespace
} // namespace tessera::viewer
