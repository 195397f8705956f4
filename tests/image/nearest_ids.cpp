// The view ids as outlines take it: of the nearest surface, whether or not light passes through it.
#include <gtest/gtest.h>

#include "engine/Renderer.h"
#include "scenes/Load.h"
#include "tests/support/GlContext.h"

namespace tessera {
namespace {

class NearestIds : public test::GlTest {};

TEST_F(NearestIds, areThoseOfASceneWithoutTransparentSurfaces) {
    const scenes::Scene opaque = scenes::loadScene("spheres");
    scenes::Scene scene = opaque;
    for (std::size_t i = 1; i < scene.materials.size(); i += 2) scene.materials[i].alphaMode = scenes::AlphaMode::Blend;
    frame::FrameSettings settings;
    settings.sizePixels = {160, 90};
    settings.view = frame::DebugView::Ids;
    engine::Renderer renderer(context(), scene), truth(context(), opaque);
    const std::vector<float> wanted = truth.render(engine::Technique::Forward, settings).radiance;
    EXPECT_FALSE(renderer.render(engine::Technique::Forward, settings).radiance == wanted) << "nothing is transparent";
    settings.idsOfNearest = true;
    EXPECT_TRUE(renderer.render(engine::Technique::Forward, settings).radiance == wanted);
    EXPECT_TRUE(truth.render(engine::Technique::Forward, settings).radiance == wanted);
}

} // namespace
} // namespace tessera
