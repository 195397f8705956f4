#include "viewer/show/DrawnShare.h"

#include <vector>

#include <gtest/gtest.h>

namespace tessera::viewer {
namespace {

TEST(DrawnShare, passesCountByWhatTheyTookBefore) {
    const std::vector<gpu::PassTiming> before{
        {"gbuffer", 10.0, 99.0}, {"lists", std::nullopt, 10.0}, {"light", 80.0, 0.1}};
    EXPECT_EQ(drawnShare(before, {0, 0.0}), 0.0);
    EXPECT_EQ(drawnShare(before, {0, 0.5}), 0.05);
    EXPECT_EQ(drawnShare(before, {2, 0.0}), 0.2);
    EXPECT_EQ(drawnShare(before, {2, 0.5}), 0.6);
    EXPECT_EQ(drawnShare(before, {3, 0.0}), 1.0);
    EXPECT_EQ(drawnShare(before, {9, 0.5}), 1.0) << "more passes than there were";
}

TEST(DrawnShare, ofNothingIsUnknown) {
    EXPECT_FALSE(drawnShare({}, {1, 0.5}));
    const std::vector<gpu::PassTiming> idle{{"clear", 0.0, 0.0}};
    EXPECT_FALSE(drawnShare(idle, {0, 0.5}));
}

} // namespace
} // namespace tessera::viewer
