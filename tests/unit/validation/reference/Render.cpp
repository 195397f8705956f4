#include "validation/reference/Render.h"

#include <atomic>

#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "scenes/builtin/Room.h"
#include "validation/reference/CameraRays.h"

namespace tessera::reference {
namespace {

namespace room = scenes::builtin;

TEST(ReferenceRender, theRoomIsAlwaysItsClosedForm) {
    const scenes::Scene scene = scenes::loadScene("room");
    for (const scenes::Camera& camera : scene.cameras) {
        Settings settings;
        settings.sizePixels = {97, 55};
        settings.camera = camera;
        std::atomic<int> rows = 0;
        const Rendered rendered = render(scene, settings, [&rows] { ++rows; });
        EXPECT_EQ(rows, 55);
        const CameraRays rays(camera, settings.sizePixels);
        int compared = 0;
        for (int row = 0; row < rendered.height; ++row) {
            for (int column = 0; column < rendered.width; ++column) {
                const Ray ray = rays.through(column, row);
                const auto seen = room::roomPointAlong(rays.eyeWS() + ray.originRel, ray.direction);
                if (!seen) continue;
                const glm::dvec3 truth = room::roomRadiance(seen->positionWS, seen->normalWS, seen->material);
                const glm::dvec3& found = rendered.radiance[std::size_t(row * rendered.width + column)];
                // Positions and normals of the scene are single precision: 6e-8 of the turned box's, times its slope.
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], truth[c], 1e-6 * truth[c]) << column << ',' << row;
                ++compared;
            }
        }
        EXPECT_GT(compared, rendered.width * rendered.height * 9 / 10);
    }
}

TEST(ReferenceRender, whereNothingIsDrawnThereIsExactlyTheBackground) {
    scenes::Scene scene;
    scene.background = {0.25f, 0.5f, 1.0f};
    Settings settings;
    settings.sizePixels = {3, 2};
    const Rendered rendered = render(scene, settings);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(rendered.radiance[i], glm::dvec3(0.25, 0.5, 1.0));
        EXPECT_EQ(rendered.covered[i], 0);
        EXPECT_EQ(rendered.ids[i], Ids{});
    }
}

TEST(ReferenceRender, idsOfTransparentTrianglesAlwaysStayBelowTheirBound) {
    for (std::uint32_t object = 0; object < 300; ++object)
        for (const std::uint32_t triangle : {0u, 1u, 77u, 4000000000u})
            EXPECT_LT(transparentId(object, triangle), 0x10000u);
    EXPECT_NE(transparentId(1, 2), transparentId(2, 1));
}

} // namespace
} // namespace tessera::reference
