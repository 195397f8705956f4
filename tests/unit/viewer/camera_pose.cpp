#include <numbers>

#include "base/Error.h"
#include "scenes/Limits.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/viewer/CameraTest.h"
#include "viewer/camera/FlyCamera.h"
#include "viewer/camera/OrbitCamera.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// Rounding of doubles, far below a pixel's hundredth.
constexpr double kRoundingPixels = 1e-7;

const std::vector<scenes::Camera>& allKinds() {
    static const std::vector<scenes::Camera> cameras = {
        perspective({1, 2, 8}, {0, 1, 0}),
        perspective({1, 2, 8}, {0, 1, 0}, {0.4, 1, 0.1}, 100.0),          // rolled
        perspective({0, 9, 0}, {0, 0, 0}, {0.3, 0, -1}),                  // straight down
        perspective({0, -9, 0}, {0, 0, 0}, {1, 0, 0}),                    // straight up
        perspective({0, 3, 0}, {0, 3, 5}, {0, -1, 0}),                    // upside down
        perspective({5e5, 10, -3e5}, {5e5 + 1, 11, -3e5 + 2}, {0, 1, 0}), // far from the origin
        orthographic({3, 4, 5}, {0, 1, 0}, 2.5),
    };
    return cameras;
}

TEST(CameraPose, aSceneCameraKeepsItsPictureThroughOrbitAndFlyAndBack) {
    for (const scenes::Camera& camera : allKinds()) {
        SCOPED_TRACE(glm::dvec3(camera.worldFromCamera[3]).x);
        const CameraPose pose = poseOf(camera, kBox);
        const OrbitCamera orbit(pose, camera);
        const FlyCamera fly(orbit.pose(), camera, kBox);
        const OrbitCamera again(fly.pose(), camera);
        // Far from the origin a position is precise to 1e-10 m, which at 3 m is 4e-8 pixels.
        const double pixels = glm::length(glm::dvec3(camera.worldFromCamera[3])) > 1e3 ? 1e-5 : kRoundingPixels;
        for (const CameraPose& one : {pose, orbit.pose(), fly.pose(), again.pose()})
            expectSamePicture(camera, cameraAt(one, camera), pixels);
    }
}

TEST(CameraPose, theFocusIsExactlyTheDepthOfTheBoundsCentreWhereThatLiesAhead) {
    const scenes::Camera towards = perspective({1, 2.5, 9}, {1, 2.5, 0});
    EXPECT_DOUBLE_EQ(poseOf(towards, kBox).focusMetres, 10.0);
    const scenes::Camera away = perspective({1, 2.5, 9}, {1, 2.5, 20});
    EXPECT_DOUBLE_EQ(poseOf(away, kBox).focusMetres, 0.5 * glm::length(kBox.max - kBox.min));
    EXPECT_DOUBLE_EQ(poseOf(away, scenes::Box3()).focusMetres, 1.0);
}

TEST(CameraPose, theNearPlaneOfTheSceneStaysUntilTheFocusComesNearer) {
    scenes::Camera start = perspective({1, 2, 8}, {0, 1, 0});
    start.nearMetres = 3.0; // cuts a wall away
    CameraPose pose = poseOf(start, kBox);
    pose.heading = turned(pose.heading, 0.3, -0.2);
    EXPECT_EQ(cameraAt(pose, start).nearMetres, 3.0);
    EXPECT_FALSE(changeOf(pose, start).nearMetres);
    pose.focusMetres *= 2.0;
    EXPECT_EQ(cameraAt(pose, start).nearMetres, 3.0);
    pose.focusMetres *= 0.25;
    EXPECT_DOUBLE_EQ(cameraAt(pose, start).nearMetres, 1.5);
}

TEST(CameraPose, zoomingInDoesNotClipTheFocus) {
    for (const double nearMetres : {1e-3, 0.1, 3.0, 20.0}) {
        SCOPED_TRACE(nearMetres);
        scenes::Camera start = perspective({1, 2, 8}, {0, 1, 0});
        start.nearMetres = nearMetres;
        CameraPose pose = poseOf(start, kBox);
        const double share = std::max(nearMetres / pose.focusMetres, 0.01);
        for (int i = 0; i < 60; ++i) {
            pose.focusMetres *= 0.5;
            EXPECT_LE(cameraAt(pose, start).nearMetres,
                      std::max(share * pose.focusMetres * (1.0 + 1e-12), scenes::kNearestPlaneMetres));
            EXPECT_LE(cameraAt(pose, start).nearMetres, nearMetres);
        }
    }
}

TEST(CameraPose, anUprightChangeNeverSaysUpAndOneAtThePoleDoes) {
    EXPECT_FALSE(changeOf(poseOf(allKinds()[0], kBox), allKinds()[0]).upWS);
    EXPECT_TRUE(changeOf(poseOf(allKinds()[1], kBox), allKinds()[1]).upWS);
    EXPECT_TRUE(changeOf(poseOf(allKinds()[2], kBox), allKinds()[2]).upWS);
}

TEST(Heading, pitchNeverPassesThePoleHoweverFarItIsTurned) {
    Heading heading;
    for (int i = 0; i < 100; ++i) heading = turned(heading, 0.0, 0.1);
    EXPECT_DOUBLE_EQ(heading.pitchRadians, kMostPitchRadians);
    for (int i = 0; i < 100; ++i) heading = turned(heading, 0.0, -0.1);
    EXPECT_DOUBLE_EQ(heading.pitchRadians, -kMostPitchRadians);
    EXPECT_LT(heading.pitchRadians, 0.0);
}

TEST(Heading, aSteeperCameraOfTheSceneIsNotMovedBeforeItIsTurnedBack) {
    const Heading down = headingOf(glm::dmat3(allKinds()[2].worldFromCamera));
    EXPECT_DOUBLE_EQ(down.pitchRadians, -0.5 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(turned(down, 0.0, -0.1).pitchRadians, down.pitchRadians);
    EXPECT_DOUBLE_EQ(turned(down, 0.0, 0.1).pitchRadians, down.pitchRadians + 0.1);
}

TEST(CameraChange, anEyeAloneMovesAndATargetAloneTurns) {
    const scenes::Camera camera = allKinds()[1];
    const glm::dmat4 placed =
        scenes::changedCamera(camera, changing(&Change::eyeWS, glm::dvec3(7, 8, 9))).worldFromCamera;
    EXPECT_EQ(glm::dmat3(placed), glm::dmat3(camera.worldFromCamera));
    EXPECT_EQ(glm::dvec3(placed[3]), glm::dvec3(7, 8, 9));
    const scenes::Camera aimed = scenes::changedCamera(camera, changing(&Change::targetWS, glm::dvec3(5, 5, 5)));
    EXPECT_EQ(glm::dvec3(aimed.worldFromCamera[3]), glm::dvec3(camera.worldFromCamera[3]));
    EXPECT_NEAR(glm::length(glm::dvec2(shownAt(aimed, {5, 5, 5}))), 0.0, kRoundingPixels);
}

TEST(CameraChange, upIsADirectionWhateverItsLength) {
    const scenes::Camera camera = perspective({1, 2, 8}, {0, 1, 0});
    const auto withUp = [&](double length) {
        return scenes::changedCamera(camera, changing(&Change::upWS, glm::dvec3(length, 2.0 * length, 0.0)));
    };
    for (const double length : {1e300, 1e-300}) expectSamePicture(withUp(1.0), withUp(length), kRoundingPixels);
}

TEST(CameraChange, invalidCameraValuesAreRefusedByName) {
    const scenes::Camera camera = allKinds()[0], parallel = allKinds().back();
    const auto refusal = [](const scenes::Camera& of, const scenes::CameraChange& change) {
        return tessera::test::errorText<InputError>([&] { scenes::changedCamera(of, change); });
    };
    EXPECT_EQ(refusal(camera, changing(&Change::targetWS, glm::dvec3(camera.worldFromCamera[3]))),
              "camera 'test': it cannot look at its own place; give another target");
    EXPECT_EQ(refusal(camera, changing(&Change::upWS, glm::dvec3(0.0))),
              "camera 'test': its up has no length; give a direction");
    EXPECT_EQ(refusal(camera, changing(&Change::fovYDegrees, 180.0)),
              "camera 'test': its field of view would be 180 degrees; less than 180 is needed");
    EXPECT_EQ(refusal(camera, changing(&Change::halfHeightMetres, 1.0)),
              "camera 'test': it is a perspective camera and has no half height; give a field of view");
    EXPECT_EQ(refusal(parallel, changing(&Change::fovYDegrees, 40.0)),
              "camera 'test': it is orthographic and has no field of view; give a half height");
    EXPECT_EQ(refusal(camera, changing(&Change::nearMetres, 2.0, &Change::farMetres, 1.0)),
              "camera 'test': its far plane would be at 1, not beyond the near one at 2; move one of them");
    EXPECT_EQ(refusal(camera, changing(&Change::nearMetres, 0.0)),
              "camera 'test': its near plane would be 0; more than 0 is needed");
    EXPECT_EQ(scenes::changedCamera(parallel, changing(&Change::nearMetres, 0.0)).nearMetres, 0.0);
}

} // namespace
} // namespace tessera::viewer
