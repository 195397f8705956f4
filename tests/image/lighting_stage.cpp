// The G-buffer lit by compute shaders gives the picture that fragment shaders give.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/ChooseLighting.h"
#include "engine/Renderer.h"
#include "scenes/Load.h"
#include "tests/support/GlContext.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;

class LightingInCompute : public test::GlTest {
protected:
    void expectForwardsPicture(engine::Renderer& renderer, frame::FrameSettings settings) {
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        settings.lightOn = frame::LightingStage::Compute;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            if (!engine::infoOf(technique.technique).choosesStage) continue;
            SCOPED_TRACE(technique.name);
            EXPECT_TRUE(renderer.render(technique.technique, settings).radiance == truth);
        }
    }
    /// Every view in every layout, or in one in turn.
    void expectEveryView();
};
using LightingInComputeSlow = LightingInCompute;

TEST_F(LightingInCompute, picturesAreThoseOfForward) {
    for (const char* name : {"hall", "lattice"}) {
        SCOPED_TRACE(name);
        frame::FrameSettings settings;
        settings.sizePixels = {321, 179};
        const scenes::Scene scene = scenes::loadScene(name);
        engine::Renderer renderer(context(), scene);
        expectForwardsPicture(renderer, settings);
    }
}

TEST_F(LightingInCompute, aSceneOfEveryFeatureIsThePictureOfForward) {
    const scenes::Scene scene = test::everythingScene(), even = test::evenScene();
    frame::FrameSettings settings;
    settings.sizePixels = {160, 88};
    engine::Renderer renderer(context(), scene), rendererOfEven(context(), even);
    expectForwardsPicture(rendererOfEven, settings);
    for (const glm::ivec2 size : {glm::ivec2(160, 88), glm::ivec2(161, 91), glm::ivec2(7, 1)}) {
        SCOPED_TRACE(fmt::format("{}x{}", size.x, size.y));
        settings.sizePixels = size;
        settings.prune = true;
        expectForwardsPicture(renderer, settings);
        settings.prune = false;
        expectForwardsPicture(renderer, settings);
    }
}

void LightingInCompute::expectEveryView() {
    const scenes::Scene scene = test::everythingScene();
    engine::Renderer renderer(context(), scene);
    const std::span<const frame::LayoutInfo> layouts = frame::layoutTable();
    std::size_t turn = 0;
    for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
        for (const frame::LayoutInfo& layout :
             test::isWholeSweep() ? layouts : layouts.subspan(turn++ % layouts.size(), 1)) {
            SCOPED_TRACE(fmt::format("{} {}", layout.name, view.name));
            frame::FrameSettings settings;
            settings.sizePixels = {97, 55};
            settings.layout = layout.layout;
            settings.view = view.view;
            settings.prune = !view.needsGBuffer; // a scene may not need the channel that is shown
            const std::vector<float> truth = renderer.render(Technique::ClusteredDeferred, settings).radiance;
            settings.lightOn = frame::LightingStage::Compute;
            EXPECT_TRUE(renderer.render(Technique::ClusteredDeferred, settings).radiance == truth);
        }
    }
}

TEST_F(LightingInCompute, everyViewIsExactlyThatOfFragmentShaders) {
    expectEveryView();
}
TEST_F(LightingInComputeSlow, everyViewAndLayoutIsExactlyThatOfFragmentShaders) {
    expectEveryView();
}

TEST_F(LightingInCompute, techniquesWithoutALightingPassRefuseIt) {
    const scenes::Scene scene = scenes::loadScene("room");
    frame::FrameSettings settings;
    settings.lightOn = frame::LightingStage::Compute;
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        if (engine::infoOf(technique.technique).choosesStage) continue;
        EXPECT_THROW(engine::planFrame(scene, technique.technique, settings), InputError) << technique.name;
    }
}

} // namespace
} // namespace tessera
