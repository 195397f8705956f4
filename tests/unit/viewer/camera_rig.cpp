#include "viewer/session/CameraRig.h"

#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

const scenes::Camera kStart = perspective({-3.2, 1.8, 4.9}, {0, 1, 0});

CameraRig rigOf(const scenes::Camera& camera) {
    return {camera, poseOf(camera, kBox), kBox};
}

void settle(CameraRig& rig) {
    rig.advance(kLongSeconds, kHeightPixels);
    EXPECT_TRUE(rig.isAtRest());
}

/// Rotates by this angle in small steps, as by hand, about the pivot or on the spot.
void turn(CameraRig& rig, double degrees) {
    const double before = rig.pose().heading.yawRadians;
    while (glm::degrees(std::abs(rig.pose().heading.yawRadians - before)) < degrees) {
        rig.rotate({40.0, 0.0}, kHeightPixels);
        settle(rig);
    }
}

TEST(CameraRig, anUnmovedCameraIsDrawnToTheLastBit) {
    for (const scenes::Camera& camera : manyCameras()) {
        CameraRig rig = rigOf(camera);
        for (const CameraRig::Mode mode : {CameraRig::Mode::Orbit, CameraRig::Mode::Fly, CameraRig::Mode::Orbit}) {
            rig.setMode(mode);
            rig.rotate({0.0, 0.0}, kHeightPixels);
            rig.pan({0.0, 0.0}, kHeightPixels);
            rig.zoom(1.0, {20.0, 30.0}, kHeightPixels);
            settle(rig);
            EXPECT_FALSE(rig.isMoved());
            EXPECT_EQ(rig.camera(), camera);
        }
    }
}

TEST(CameraRig, homeIsTheCameraItStartedAsHoweverFarItTurned) {
    for (const CameraRig::Mode mode : {CameraRig::Mode::Orbit, CameraRig::Mode::Fly})
        for (const double degrees : {20.0, 200.0, 900.0}) {
            SCOPED_TRACE(degrees);
            CameraRig rig = rigOf(kStart);
            rig.setMode(mode);
            turn(rig, degrees);
            EXPECT_TRUE(rig.isMoved());
            rig.goHome();
            EXPECT_LE(std::abs(rig.pose().heading.yawRadians - poseOf(kStart, kBox).heading.yawRadians),
                      glm::radians(180.0))
                << "the shorter way round";
            settle(rig);
            EXPECT_FALSE(rig.isMoved());
            EXPECT_EQ(rig.camera(), kStart);
        }
}

TEST(CameraRig, aPointToTurnAboutNeverMovesTheEyeNearerAndBehindItNothingHappens) {
    const glm::dvec3 pivotWS(0.7, 0.4, -1.2);
    CameraRig rig = rigOf(kStart);
    const double depthMetres = shownAt(kStart, pivotWS).z;
    rig.turnAbout(pivotWS);
    settle(rig);
    const glm::dvec3 shown = shownAt(rig.camera(), pivotWS);
    EXPECT_NEAR(glm::length(glm::dvec2(shown)), 0.0, 1e-6);
    EXPECT_NEAR(shown.z, depthMetres, 1e-9);
    turn(rig, 90.0);
    EXPECT_NEAR(glm::length(glm::dvec2(shownAt(rig.camera(), pivotWS))), 0.0, 1e-6) << "it turns about another";
    const CameraPose before = rig.pose();
    rig.turnAbout(before.eyeWS - before.heading.forwardWS());
    settle(rig);
    EXPECT_EQ(rig.pose(), before);
    rig.setMode(CameraRig::Mode::Fly);
    rig.turnAbout(pivotWS);
    settle(rig);
    EXPECT_EQ(rig.pose(), before) << "who flies stays";
}

TEST(CameraRig, theWheelZoomsWhereOneOrbitsAndSetsTheSpeedWhereOneFlies) {
    CameraRig rig = rigOf(kStart);
    const double speed = rig.flyMetresPerSecond(), distanceMetres = rig.pose().focusMetres;
    rig.wheel(1.0, {}, kHeightPixels);
    settle(rig);
    EXPECT_NEAR(rig.pose().focusMetres, 0.88 * distanceMetres, 1e-9);
    EXPECT_EQ(rig.flyMetresPerSecond(), speed);
    rig.setMode(CameraRig::Mode::Fly);
    const CameraPose before = rig.pose();
    rig.wheel(2.0, {100.0, 50.0}, kHeightPixels);
    EXPECT_TRUE(rig.isAtRest());
    EXPECT_EQ(rig.pose(), before);
    EXPECT_DOUBLE_EQ(rig.flyMetresPerSecond(), 2.0 * speed);
    CameraRig next = rigOf(kStart);
    next.moveAs(rig);
    EXPECT_EQ(next.mode(), CameraRig::Mode::Fly);
    EXPECT_DOUBLE_EQ(next.flyMetresPerSecond(), 2.0 * speed);
}

} // namespace
} // namespace tessera::viewer
