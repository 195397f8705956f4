#include "viewer/camera/FlyCamera.h"

#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

struct FlyRig {
    scenes::Camera lens = perspective({0, 1, 8}, {0, 1, 0});
    FlyCamera fly{poseOf(lens, kBox), lens, kBox};
    glm::dvec3 eyeWS() const { return fly.pose().eyeWS; }
};

TEST(FlyCamera, everyKeyMovesItsWayAndOppositeOnesCancel) {
    FlyRig rig;
    const auto velocity = [&](const FlyKeys& keys) {
        rig.fly.hold(keys);
        const glm::dvec3 velocityWS = rig.fly.velocityWS();
        return glm::length(velocityWS) > 0.0 ? glm::normalize(velocityWS) : velocityWS;
    };
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-12; };
    EXPECT_TRUE(near(velocity({.forward = true}), {0, 0, -1}));
    EXPECT_TRUE(near(velocity({.back = true}), {0, 0, 1}));
    EXPECT_TRUE(near(velocity({.left = true}), {-1, 0, 0}));
    EXPECT_TRUE(near(velocity({.right = true}), {1, 0, 0}));
    EXPECT_TRUE(near(velocity({.down = true}), {0, -1, 0}));
    EXPECT_TRUE(near(velocity({.up = true}), {0, 1, 0}));
    EXPECT_EQ(velocity({.left = true, .right = true}), glm::dvec3(0.0));
}

TEST(FlyCamera, speedGoesWithTheSizeOfTheSceneAndShiftIsFaster) {
    FlyRig rig;
    rig.fly.hold({.forward = true});
    const double slow = glm::length(rig.fly.velocityWS());
    rig.fly.hold({.forward = true, .right = true, .fast = true});
    EXPECT_NEAR(glm::length(rig.fly.velocityWS()), 5.0 * slow, 1e-12) << "and no faster diagonally";
    FlyCamera large(rig.fly.pose(), rig.lens, {1000.0 * kBox.min, 1000.0 * kBox.max});
    large.hold({.forward = true});
    EXPECT_NEAR(glm::length(large.velocityWS()), 1000.0 * slow, 1e-9);
}

TEST(FlyCamera, twoStepsDoubleTheSpeedWithinASixteenthAnd16TimesIt) {
    FlyRig rig;
    rig.fly.hold({.forward = true});
    const double usual = glm::length(rig.fly.velocityWS());
    EXPECT_DOUBLE_EQ(rig.fly.metresPerSecond(), usual);
    const auto expectTimes = [&](double steps, double times) {
        rig.fly.changeSpeed(steps);
        EXPECT_NEAR(glm::length(rig.fly.velocityWS()), times * usual, 1e-12 * times * usual) << steps;
        EXPECT_DOUBLE_EQ(rig.fly.metresPerSecond(), glm::length(rig.fly.velocityWS()));
    };
    for (const auto& [steps, times] :
         {std::pair(2.0, 2.0), {-4.0, 0.5}, {2.0, 1.0}, {100.0, 16.0}, {-8.0, 1.0}, {-100.0, 1.0 / 16.0}})
        expectTimes(steps, times);
    FlyCamera large(rig.fly.pose(), rig.lens, {1000.0 * kBox.min, 1000.0 * kBox.max});
    large.takeSpeedFactor(rig.fly);
    EXPECT_NEAR(large.metresPerSecond(), 1000.0 / 16.0 * usual, 1e-9) << "of its own scene";
}

TEST(FlyCamera, twoHalfStepsAreOneStepAlsoWhileAKeyIsHeld) {
    FlyRig one, two;
    for (FlyRig* rig : {&one, &two}) {
        rig->fly.look({200.0, 80.0}, kHeightPixels);
        rig->fly.hold({.forward = true, .up = true});
    }
    one.fly.advance(0.12, kHeightPixels);
    for (int i = 0; i < 12; ++i) two.fly.advance(0.01, kHeightPixels);
    EXPECT_LT(glm::distance(one.eyeWS(), two.eyeWS()), 1e-12);
    EXPECT_NEAR(one.fly.pose().heading.yawRadians, two.fly.pose().heading.yawRadians, 1e-12);
    EXPECT_GT(glm::distance(one.eyeWS(), glm::dvec3(0, 1, 8)), 0.01);
}

TEST(FlyCamera, mouseLookMovesThePictureByThePixelsOfTheMouseTheOtherWay) {
    FlyRig rig;
    const glm::dvec3 pointWS = rig.eyeWS() + 5.0 * rig.fly.pose().heading.forwardWS();
    rig.fly.look({4.0, -3.0}, kHeightPixels);
    rig.fly.advance(10.0, kHeightPixels);
    const glm::dvec3 shown = shownAt(cameraAt(rig.fly.pose(), rig.lens), pointWS);
    EXPECT_NEAR(shown.x, -4.0, 0.01); // small angles
    EXPECT_NEAR(shown.y, 3.0, 0.01);
}

TEST(FlyCamera, itIsNotAtRestWhileAKeyMovesItAndComesToRestAfter) {
    FlyRig rig;
    EXPECT_TRUE(rig.fly.isAtRest());
    rig.fly.hold({.forward = true});
    rig.fly.advance(0.5, kHeightPixels);
    EXPECT_FALSE(rig.fly.isAtRest());
    rig.fly.hold({});
    EXPECT_FALSE(rig.fly.isAtRest());
    int steps = 0;
    for (; !rig.fly.isAtRest() && steps < 100; ++steps) rig.fly.advance(0.016, kHeightPixels);
    EXPECT_LT(steps, 100) << "1.6 seconds are twenty dampings";
    EXPECT_EQ(rig.fly.pose(), rig.fly.goal());
}

} // namespace
} // namespace tessera::viewer
