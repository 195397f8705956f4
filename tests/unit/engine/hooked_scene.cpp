#include "engine/HookedScene.h"

#include <gtest/gtest.h>

#include "tests/unit/scenes/TinyScene.h"

namespace tessera::engine {
namespace {

/// Meshes that the hook leaves alone remain the scene's, because a morph target may change them.
TEST(HookedScene, takesColoursOfVerticesThatTheHookDoesNotMove) {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials.emplace_back().name = "hooked";
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[0].colors.assign(3, glm::vec4(0.5f));
    scene.nodes[0].instances.push_back({1, 1});
    scenes::Hook& hook = scene.hook.emplace();
    hook.movesVertices = true;
    hook.materials = {1};
    HookedScene hooked(scene);
    scene.meshes[0].colors[1] = {0.1f, 0.2f, 0.3f, 1.0f};
    scene.meshes[1].positionsOS[2].y = 7.0f;
    hooked.takeMeshes();
    EXPECT_EQ(hooked.scene().meshes[0].colors, scene.meshes[0].colors);
    EXPECT_EQ(hooked.scene().meshes[1].positionsOS, scene.meshes[1].positionsOS) << "until it moves them";
}

} // namespace
} // namespace tessera::engine
