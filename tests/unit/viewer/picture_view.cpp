#include <gtest/gtest.h>

#include "renderer/frame/CameraView.h"
#include "scenes/LookAt.h"
#include "tests/unit/viewer/CameraTest.h"
#include "viewer/camera/PictureView.h"

namespace tessera::viewer {
namespace {

constexpr glm::dvec2 kPicture{640.0, 360.0};

scenes::Camera pictureCamera(scenes::Projection projection) {
    scenes::Camera camera = test::perspective({3.0, 2.0, 5.0}, {0.5, 0.25, -1.0});
    camera.projection = projection;
    camera.halfHeightMetres = 2.5;
    return camera;
}
constexpr scenes::Projection kBoth[] = {scenes::Projection::Perspective, scenes::Projection::Orthographic};

TEST(PictureView, aPointIsWhereTheRendererDrawsIt) {
    for (const scenes::Projection projection : kBoth) {
        const scenes::Camera camera = pictureCamera(projection);
        const frame::CameraView drawn =
            frame::makeCameraView(camera, glm::ivec2(kPicture), frame::LightingSpace::World, glm::vec3(0.0f));
        const PictureView view(camera, kPicture);
        for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(1.0, -0.5, -2.0), glm::dvec3(-1.0, 1.0, 0.5)}) {
            const glm::dvec4 clip = drawn.clipFromLS * glm::dvec4(drawn.positionLS(point), 1.0);
            const auto place = view.placeOf(point);
            ASSERT_TRUE(place.has_value());
            // Both take a handful of operations in double precision.
            EXPECT_NEAR(place->x / kPicture.x, 0.5 + 0.5 * clip.x / clip.w, 1e-12);
            EXPECT_NEAR(place->y / kPicture.y, 0.5 - 0.5 * clip.y / clip.w, 1e-12);
        }
    }
}

TEST(PictureView, pointsBehindTheCameraAreNotInThePicture) {
    const scenes::Camera camera = pictureCamera(scenes::Projection::Perspective);
    const glm::dvec3 behindWS = glm::dvec3(camera.worldFromCamera[3] + camera.worldFromCamera[2]);
    const PictureView view(camera, kPicture);
    EXPECT_FALSE(view.placeOf(behindWS));
    EXPECT_FALSE(view.metresPerUnit(behindWS));
}

TEST(PictureView, theLineOfSightAtAPlaceRunsThroughWhatIsShownThere) {
    for (const scenes::Projection projection : kBoth) {
        const PictureView view(pictureCamera(projection), kPicture);
        for (const glm::dvec3& pointWS : {glm::dvec3(0.0), glm::dvec3(1.0, -0.5, -2.0), glm::dvec3(-1.0, 1.0, 0.5)}) {
            const SightLine line = view.sightLineAt(view.placeOf(pointWS).value());
            const glm::dvec3 toPointWS = pointWS - line.originWS;
            EXPECT_NEAR(glm::length(line.directionWS), 1.0, 1e-12);
            EXPECT_GT(glm::dot(toPointWS, line.directionWS), 0.0);
            EXPECT_LT(glm::length(glm::cross(toPointWS, line.directionWS)), 1e-12);
            EXPECT_LT(glm::length(view.towardsViewerWS(pointWS) + line.directionWS), 1e-12);
            // A point a metre to the right at the point's depth.
            const double units = view.placeOf(pointWS + view.rightWS())->x - view.placeOf(pointWS)->x;
            EXPECT_NEAR(units * view.metresPerUnit(pointWS).value(), 1.0, 1e-9);
        }
    }
}

TEST(PictureView, aLineEndsAtTheNearPlaneAndAtThePicturesSides) {
    scenes::Camera camera = test::perspective({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 90.0);
    camera.nearMetres = 0.5;
    const PictureView view(camera, {200.0, 100.0}); // at a depth d, 100 units are 2 d
    const auto within = view.lineBetween({-1.0, 0.5, -2.0}, {1.0, 0.0, -2.0});
    ASSERT_TRUE(within);
    EXPECT_NEAR(glm::distance(within->first, {75.0, 37.5}), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(within->second, {125.0, 50.0}), 0.0, 1e-9);
    // From behind the viewer, the line enters the view at (0.1, 0, -0.5), in either direction.
    const glm::dvec3 behindWS(0.1, 0.0, 3.0), aheadWS(0.1, 0.0, -5.0);
    const glm::dvec2 enters(100.0 + 50.0 * 0.1 / 0.5, 50.0), ends(100.0 + 50.0 * 0.1 / 5.0, 50.0);
    for (const bool isTurned : {false, true}) {
        const auto line = isTurned ? view.lineBetween(aheadWS, behindWS) : view.lineBetween(behindWS, aheadWS);
        ASSERT_TRUE(line);
        EXPECT_NEAR(glm::distance(isTurned ? line->second : line->first, enters), 0.0, 1e-9);
        EXPECT_NEAR(glm::distance(isTurned ? line->first : line->second, ends), 0.0, 1e-9);
    }
    const auto wide = view.lineBetween({-1e6, 0.0, -1.0}, {1e6, 0.0, -1.0});
    ASSERT_TRUE(wide);
    EXPECT_NEAR(wide->first.x, 0.0, 1e-6);
    EXPECT_NEAR(wide->second.x, 200.0, 1e-6);
    EXPECT_FALSE(view.lineBetween({-1.0, 5.0, -1.0}, {1.0, 5.0, -1.0})) << "above the picture";
    EXPECT_FALSE(view.lineBetween({0.0, 0.0, 1.0}, {0.0, 1.0, 2.0})) << "behind the viewer";
}

} // namespace
} // namespace tessera::viewer
