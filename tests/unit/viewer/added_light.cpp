#include "viewer/edit/AddedLight.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// A wall of 20 x 20 m that faces z, 10 m before the camera, and a floor `belowMetres` below the camera.
scenes::Scene wallAndFloor(float belowMetres) {
    scenes::Scene scene;
    scene.materials.emplace_back();
    scenes::Mesh& mesh = scene.meshes.emplace_back();
    mesh.positionsOS = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
    mesh.normalsOS.assign(4, {0, 0, 1});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.nodes.emplace_back().instances.push_back({0, 0});
    scenes::Node& floor = scene.nodes.emplace_back(scene.nodes.front());
    floor.parentFromNode = glm::dmat4(glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0)); // its z is up
    floor.parentFromNode[3] = glm::dvec4(0, -double(belowMetres), 0, 1);
    return scene;
}

const CameraPose kPose = poseOf(perspective({0, 0, 10}, {0, 0, 0}), {{-10, -10, -10}, {10, 10, 10}});

TEST(AddedLight, isHalfwayToWhatIsSeenAndAsBrightOnTheNearestSurfaceAsWanted) {
    for (const float below : {1.0f, 2.5f}) {
        const scenes::Light light = lightBefore(wallAndFloor(below), kPose, 0.25);
        EXPECT_LT(glm::distance(light.positionWS, glm::dvec3(0, 0, 5)), 1e-3);
        const double lux = double(light.intensity) / double(below * below);
        EXPECT_NEAR(lux * 0.5 / std::numbers::pi, 0.25, 1e-3) << "of a grey floor";
        EXPECT_NEAR(light.rangeMetres, 4.0f * below, 1e-2f);
    }
    scenes::Scene empty;
    const scenes::Light light = lightBefore(empty, kPose, 0.25);
    EXPECT_NEAR(glm::distance(light.positionWS, kPose.eyeWS), 0.5 * kPose.focusMetres, 1e-9);
    EXPECT_TRUE(std::isfinite(light.intensity) && light.intensity > 0.0f);
}

TEST(AddedLight, isNoticedInDarkPicturesAndBurnsNoBrightOnes) {
    EXPECT_DOUBLE_EQ(noticedLuminance(0.1, 0.0), 0.2);
    EXPECT_DOUBLE_EQ(noticedLuminance(0.0, 0.0), 0.15);
    EXPECT_DOUBLE_EQ(noticedLuminance(3.0, 0.0), 0.5);
    EXPECT_DOUBLE_EQ(noticedLuminance(100.0, -10.0), 100.0 * 2.0) << "as the display shows it";
}

} // namespace
} // namespace tessera::viewer
