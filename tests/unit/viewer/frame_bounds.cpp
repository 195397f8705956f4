#include "viewer/camera/FrameBounds.h"

#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

std::vector<glm::dvec3> cornersOf(const scenes::Box3& box) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(
            {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    return corners;
}

void expectAllInView(const scenes::Box3& box, const scenes::Camera& camera, double aspect) {
    for (const glm::dvec3& cornerWS : cornersOf(box)) {
        const glm::dvec3 shown = shownAt(camera, cornerWS);
        EXPECT_LT(std::abs(shown.x), 0.5 * kHeightPixels * aspect);
        EXPECT_LT(std::abs(shown.y), 0.5 * kHeightPixels);
        EXPECT_GT(shown.z, camera.nearMetres);
        EXPECT_LT(shown.z, camera.farMetres);
    }
}

std::vector<Heading> headings() {
    return {{}, {2.1, 0.4, 0.0}, {-0.7, -1.5, 0.3}, {0.2, kMostPitchRadians, 0.0}};
}

TEST(FrameBounds, everyCornerIsInViewForAnyFieldOfViewAspectAndHeading) {
    for (const scenes::Box3& box : {kBox, scenes::Box3{{1e4, 0, 0}, {1e4 + 1e-3, 1e-3, 1e-3}},
                                    scenes::Box3{{-1, 2, 0}, {1, 2, 0}}, scenes::Box3{{-1e5, 0, -1e5}, {1e5, 1, 1e5}}})
        for (const Heading& heading : headings())
            for (const double aspect : {0.1, 0.75, 1.0, 16.0 / 9.0, 8.0}) {
                CameraPose pose;
                pose.heading = heading;
                pose.farMetres = 1.0;
                for (const double fovYDegrees : {0.5, 20.0, 45.0, 90.0, 170.0}) {
                    const scenes::Camera lens = perspective({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, fovYDegrees);
                    const CameraPose framed = frameBounds(box, pose, lens, aspect);
                    expectAllInView(box, cameraAt(framed, lens), aspect);
                    EXPECT_EQ(framed.heading, heading);
                }
                const scenes::Camera parallel = orthographic({0, 0, 1}, {0, 0, 0}, 1.0);
                expectAllInView(box, cameraAt(frameBounds(box, pose, parallel, aspect), parallel), aspect);
            }
}

TEST(FrameBounds, thePictureIsFilledUpToItsMargin) {
    const scenes::Camera lens = perspective({0, 0, 1}, {0, 0, 0});
    const scenes::Camera camera = cameraAt(frameBounds(kBox, CameraPose(), lens, 1.5), lens);
    double reach = 0.0;
    for (const glm::dvec3& cornerWS : cornersOf(kBox)) {
        const glm::dvec3 shown = shownAt(camera, cornerWS);
        reach = std::max({reach, std::abs(shown.x) / (750.0), std::abs(shown.y) / 500.0});
    }
    EXPECT_NEAR(reach, 1.0 / 1.05, 1e-9); // a margin of 5 percent
}

TEST(FrameBounds, anEmptySceneIsSeenAsABallAboutTheOrigin) {
    const scenes::Camera lens = perspective({0, 0, 1}, {0, 0, 0});
    const CameraPose framed = frameBounds(scenes::Box3(), CameraPose(), lens, 1.0);
    EXPECT_LT(glm::distance(framed.eyeWS, glm::dvec3(0.0, 0.0, framed.focusMetres)), 1e-12);
    expectAllInView({glm::dvec3(-0.5), glm::dvec3(0.5)}, cameraAt(framed, lens), 1.0);
    const scenes::Box3 point{glm::dvec3(3.0), glm::dvec3(3.0)};
    const CameraPose near = frameBounds(point, CameraPose(), lens, 1.0);
    EXPECT_LT(glm::distance(near.eyeWS, glm::dvec3(3.0, 3.0, 3.0 + framed.focusMetres)), 1e-12);
}

} // namespace
} // namespace tessera::viewer
