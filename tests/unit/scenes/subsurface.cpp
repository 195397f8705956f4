#include "scenes/Subsurface.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/InUse.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

TEST(SubsurfaceMethods, diffuseOverWhatIsDrawnAndRequestsThem) {
    for (const SubsurfaceMethodInfo& method : subsurfaceMethods()) {
        Scene scene = tinyScene();
        Material& material = scene.materials[0];
        material.subsurface.method = method.method;
        EXPECT_EQ(anyDiffuses(scene, {}), method.diffuses) << method.name;
        EXPECT_FALSE(anyDiffuses(scene, SubsurfaceMethod::Wrap)) << method.name;
        EXPECT_EQ(anyDiffuses(scene, SubsurfaceMethod::TextureSpaceDiffusion), method.method != SubsurfaceMethod::None)
            << method.name;
        for (Mesh& mesh : scene.meshes) mesh.indices.clear();
        EXPECT_FALSE(anyDiffuses(scene, SubsurfaceMethod::TextureSpaceDiffusion)) << "nothing is drawn";
    }
}

TEST(SubsurfaceMethods, haveOneThatDiffusesAndItPassesLightToo) {
    EXPECT_EQ(std::ranges::count_if(subsurfaceMethods(), &SubsurfaceMethodInfo::diffuses), 1);
    for (const SubsurfaceMethodInfo& method : subsurfaceMethods()) {
        EXPECT_TRUE(method.passes || !method.diffuses) << method.name;
        EXPECT_FALSE(method.wraps && method.passes) << method.name << ": a row of constants holds one of them";
    }
}

} // namespace
} // namespace tessera::scenes
