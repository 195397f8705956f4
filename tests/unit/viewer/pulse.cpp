#include "viewer/session/Pulse.h"

#include <gtest/gtest.h>

namespace tessera::viewer {
namespace {

TEST(Gliding, aSlowPictureThatGoesOnInADragWaitsForTheNextMovement) {
    constexpr double kShownAt = 7.0;
    const Gliding slow{.isButtonHeld = true, .isMoving = true, .ms = 10.5, .shownAt = kShownAt};
    EXPECT_DOUBLE_EQ(slow.from(), 7.01);
    const auto changed = [&](auto change) {
        Gliding other = slow;
        change(other);
        return other.from();
    };
    EXPECT_EQ(changed([](Gliding& other) { other.isButtonHeld = false; }), 0.0) << "nothing is dragged";
    EXPECT_EQ(changed([](Gliding& other) { other.isMoving = false; }), 0.0) << "no picture follows by itself";
    EXPECT_EQ(changed([](Gliding& other) { other.ms = 9.5; }), 0.0) << "a picture is done before the movement is heard";
    EXPECT_DOUBLE_EQ(changed([](Gliding& other) { other.ms = 1000.0; }), 7.01) << "however slow it is";
    EXPECT_DOUBLE_EQ(changed([](Gliding& other) { other.shownAt = 8.0; }), 8.01);
    EXPECT_EQ(Gliding{}.from(), 0.0);
}

} // namespace
} // namespace tessera::viewer
