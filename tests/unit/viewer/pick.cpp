#include "viewer/edit/Pick.h"

#include "tests/support/TestScenes.h"
#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// Two squares of two triangles each that face +Z: a small one at z = 1 at the second node, and a large one at z = 0 as
/// the second instance of the first node, whose first instance is out of view. Triangle 0 is the lower right one.
scenes::Scene squares(scenes::AlphaMode nearMode = scenes::AlphaMode::Opaque) {
    scenes::Scene scene;
    scene.materials.resize(3);
    scene.materials[2].alphaMode = nearMode;
    scene.meshes.assign(2, tessera::test::quad());
    for (glm::vec3& position : scene.meshes[0].positionsOS) position += glm::vec3(100.0f, 0.0f, 0.0f);
    scenes::Node& large = scene.nodes.emplace_back();
    large.instances = {{0, 0}, {1, 1}};
    large.parentFromNode = glm::dmat4(glm::dmat3(4.0));
    scenes::Node& small = scene.nodes.emplace_back();
    small.instances = {{1, 2}};
    small.parentFromNode[3] = glm::dvec4(0, 0, 1, 1);
    return scene;
}

const scenes::Camera kCamera = orthographic({0, 0, 5}, {0, 0, 0}, 4.0);
constexpr glm::ivec2 kSizePixels{80, 80}; // ten pixels per metre

TEST(Pick, aPixelIsTheNearestTrianglesNodeInstanceAndMaterial) {
    const scenes::Scene scene = squares();
    const auto at = [&](int x, int y) { return pickedByRay(scene, kCamera, kSizePixels, {x, y}); };
    const std::optional<Pick> small = at(44, 44);
    ASSERT_TRUE(small);
    EXPECT_EQ(std::tie(small->node, small->instance, small->mesh, small->material, small->triangle),
              std::tuple(1, 0, 1, 2, 0));
    EXPECT_LT(glm::distance(small->positionWS, glm::dvec3(0.45, -0.45, 1.0)), 1e-9);
    EXPECT_EQ(at(36, 36).value().triangle, 1);
    const std::optional<Pick> large = at(70, 70);
    ASSERT_TRUE(large);
    EXPECT_EQ(std::tie(large->node, large->instance, large->material), std::tuple(0, 1, 1));
}

TEST(Pick, aTransparentSurfaceIsPickedBeforeTheSurfaceBehind) {
    const scenes::Scene scene = squares(scenes::AlphaMode::Blend);
    EXPECT_EQ(pickedByRay(scene, kCamera, kSizePixels, {44, 44}).value().node, 1);
}

TEST(Pick, whereNothingIsNothingIsPicked) {
    const scenes::Camera away = orthographic({0, 0, 5}, {0, 0, 10}, 4.0);
    EXPECT_FALSE(pickedByRay(squares(), away, kSizePixels, {40, 40}));
    EXPECT_FALSE(pickedByRay(scenes::Scene(), kCamera, kSizePixels, {40, 40}));
}

} // namespace
} // namespace tessera::viewer
