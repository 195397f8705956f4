#include "scenes/Subsurface.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/InUse.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

TEST(SubsurfaceMethods, spreadOverWhatIsDrawnAndAsksForThem) {
    for (const SubsurfaceMethodInfo& method : subsurfaceMethods()) {
        Scene scene = tinyScene();
        Material& material = scene.materials[0];
        material.subsurface.method = method.method;
        EXPECT_EQ(anySpreads(scene, {}), method.spreads) << method.name;
        EXPECT_FALSE(anySpreads(scene, SubsurfaceMethod::Wrap)) << method.name;
        EXPECT_EQ(anySpreads(scene, SubsurfaceMethod::TextureSpaceDiffusion), method.method != SubsurfaceMethod::None)
            << method.name;
        for (Mesh& mesh : scene.meshes) mesh.indices.clear();
        EXPECT_FALSE(anySpreads(scene, SubsurfaceMethod::TextureSpaceDiffusion)) << "nothing is drawn";
    }
}

TEST(SubsurfaceMethods, haveOneThatSpreadsAndItPassesLightToo) {
    EXPECT_EQ(std::ranges::count_if(subsurfaceMethods(), &SubsurfaceMethodInfo::spreads), 1);
    for (const SubsurfaceMethodInfo& method : subsurfaceMethods()) {
        EXPECT_TRUE(method.passes || !method.spreads) << method.name;
        EXPECT_FALSE(method.wraps && method.passes) << method.name << ": a row of constants holds one of them";
    }
}

} // namespace
} // namespace tessera::scenes
