// Lighting the G-buffer in compute shaders gives the image of fragment shaders.

#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/ChooseLighting.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

class LightingInCompute : public ImageTest {
protected:
    static std::vector<Technique> choosing() {
        std::vector<Technique> techniques;
        for (const engine::TechniqueInfo& info : engine::techniqueTable())
            if (info.choosesStage) techniques.push_back(info.technique);
        return techniques;
    }
    /// Compares these techniques with forward, which is pruned: that changes no bit (Invariance) and compiles faster.
    void expectForwardsPicture(engine::Renderer& renderer, frame::FrameSettings settings,
                               std::span<const Technique> techniques) {
        const bool prune = std::exchange(settings.prune, true);
        const std::vector<float> truth = renderer.render(Technique::Forward, settings).radiance;
        settings.prune = prune;
        settings.lightOn = frame::LightingStage::Compute;
        for (const Technique technique : techniques) {
            SCOPED_TRACE(engine::infoOf(technique).name);
            EXPECT_TRUE(renderer.render(technique, settings).radiance == truth);
        }
    }
};

TEST_F(LightingInCompute, picturesAreThoseOfForward) {
    for (const char* name : {"hall", "lattice"}) {
        SCOPED_TRACE(name);
        frame::FrameSettings settings = ofSize(161, 91);
        const scenes::Scene scene = scenes::loadScene(name);
        engine::Renderer renderer(context(), scene);
        expectForwardsPicture(renderer, settings, choosing());
    }
}

/// With every technique, pruned and unpruned; or pruned, with one in turn.
TEST_SWEEP_AS(LightingInCompute, aSceneOfEveryFeatureIsThePictureOfForward, LightingInComputeSlow,
              aSceneOfEveryFeatureIsThePictureOfForwardWithEveryTechnique) {
    const std::vector<Technique> techniques = choosing();
    const scenes::Scene scene = everythingScene(), even = evenScene();
    frame::FrameSettings settings = ofSize(160, 88);
    engine::Renderer renderer(context(), scene), rendererOfEven(context(), even);
    std::size_t turn = 0;
    expectForwardsPicture(rendererOfEven, settings, inTurn(techniques, turn++));
    for (const glm::ivec2 size : {glm::ivec2(160, 88), glm::ivec2(161, 91), glm::ivec2(7, 1)}) {
        SCOPED_TRACE(fmt::format("{}x{}", size.x, size.y));
        settings.sizePixels = size;
        // One technique for all sizes, which share its programs.
        settings.prune = true;
        expectForwardsPicture(renderer, settings, inTurn(techniques, turn));
        if (!isWholeSweep()) continue;
        settings.prune = false;
        expectForwardsPicture(renderer, settings, inTurn(techniques, turn + 1));
    }
}

/// Every view of a scene of everything in every layout. In a short sweep every sixth of its metal in one layout in
/// turn; views of G-buffer channels, which are unlit, only in `exact`.
TEST_SWEEP_AS(LightingInCompute, everyViewIsExactlyThatOfFragmentShaders, LightingInComputeSlow,
              everyViewAndLayoutIsExactlyThatOfFragmentShaders) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    engine::Renderer renderer(context(), scene);
    std::size_t turn = 0, channels = 0, lit = 0;
    for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
        if (!isWholeSweep() && (view.needsGBuffer ? channels : lit)++ % 6 != 0) continue;
        for (const frame::LayoutInfo& layout : inTurn(frame::layoutTable(), view.needsGBuffer ? 0 : turn++)) {
            SCOPED_TRACE(fmt::format("{} {}", layout.name, view.name));
            frame::FrameSettings settings = withView(ofSize(97, 55), view.view);
            settings.layout = layout.layout;
            settings.prune = !view.needsGBuffer; // pruning may drop the displayed channel
            const std::vector<float> truth = renderer.render(Technique::ClusteredDeferred, settings).radiance;
            settings.lightOn = frame::LightingStage::Compute;
            EXPECT_TRUE(renderer.render(Technique::ClusteredDeferred, settings).radiance == truth);
        }
    }
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
