#include <gtest/gtest.h>

#include "renderer/frame/CameraView.h"
#include "scenes/LookAt.h"
#include "viewer/session/Projection.h"

namespace tessera::viewer {
namespace {

scenes::Camera cameraOf(scenes::Projection projection) {
    scenes::Camera camera;
    camera.projection = projection;
    camera.worldFromCamera = scenes::worldFromLookAt({3.0, 2.0, 5.0}, {0.5, 0.25, -1.0});
    camera.halfHeightMetres = 2.5;
    return camera;
}

TEST(Projection, aPointIsWhereTheRendererDrawsIt) {
    const glm::ivec2 size(640, 360);
    for (const auto projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        const scenes::Camera camera = cameraOf(projection);
        const frame::CameraView view =
            frame::makeCameraView(camera, size, frame::LightingSpace::World, glm::vec3(0.0f));
        for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(1.0, -0.5, -2.0), glm::dvec3(-1.0, 1.0, 0.5)}) {
            const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.positionLS(point), 1.0);
            const auto place = projected(camera, double(size.x) / size.y, point);
            ASSERT_TRUE(place.has_value());
            // Both are double precision over a handful of operations.
            EXPECT_NEAR(place->x, 0.5 + 0.5 * clip.x / clip.w, 1e-12);
            EXPECT_NEAR(place->y, 0.5 - 0.5 * clip.y / clip.w, 1e-12);
        }
    }
}

TEST(Projection, pointsBehindTheCameraAreNotInThePicture) {
    const scenes::Camera camera = cameraOf(scenes::Projection::Perspective);
    const glm::dvec3 backWS(camera.worldFromCamera[2]);
    EXPECT_FALSE(projected(camera, 1.0, glm::dvec3(camera.worldFromCamera[3]) + backWS).has_value());
}

} // namespace
} // namespace tessera::viewer
