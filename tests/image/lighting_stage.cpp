// The G-buffer lit by compute shaders gives the picture that fragment shaders give.
#include <utility>

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
    static std::vector<Technique> choosing() {
        std::vector<Technique> techniques;
        for (const engine::TechniqueInfo& info : engine::techniqueTable())
            if (info.choosesStage) techniques.push_back(info.technique);
        return techniques;
    }
    /// With those techniques. Forward's is pruned, which changes no bit (Invariance) and takes less to compile.
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
    /// With every technique, pruned and not; or pruned, with one in turn.
    void expectEveryFeature();
    /// Every view of a scene of everything in every layout, or each sixth of its metal in one layout in turn; of
    /// channels of the G-buffer, which are not lit, then in `exact` alone.
    void expectEveryView();
};
using LightingInComputeSlow = LightingInCompute;

TEST_F(LightingInCompute, picturesAreThoseOfForward) {
    for (const char* name : {"hall", "lattice"}) {
        SCOPED_TRACE(name);
        frame::FrameSettings settings;
        settings.sizePixels = {161, 91};
        const scenes::Scene scene = scenes::loadScene(name);
        engine::Renderer renderer(context(), scene);
        expectForwardsPicture(renderer, settings, choosing());
    }
}

void LightingInCompute::expectEveryFeature() {
    const std::vector<Technique> techniques = choosing();
    const scenes::Scene scene = test::everythingScene(), even = test::evenScene();
    frame::FrameSettings settings;
    settings.sizePixels = {160, 88};
    engine::Renderer renderer(context(), scene), rendererOfEven(context(), even);
    std::size_t turn = 0;
    expectForwardsPicture(rendererOfEven, settings, test::inTurn(techniques, turn++));
    for (const glm::ivec2 size : {glm::ivec2(160, 88), glm::ivec2(161, 91), glm::ivec2(7, 1)}) {
        SCOPED_TRACE(fmt::format("{}x{}", size.x, size.y));
        settings.sizePixels = size;
        // One for all sizes, each of which shares its programs.
        settings.prune = true;
        expectForwardsPicture(renderer, settings, test::inTurn(techniques, turn));
        if (!test::isWholeSweep()) continue;
        settings.prune = false;
        expectForwardsPicture(renderer, settings, test::inTurn(techniques, turn + 1));
    }
}

TEST_F(LightingInCompute, aSceneOfEveryFeatureIsThePictureOfForward) {
    expectEveryFeature();
}
TEST_F(LightingInComputeSlow, aSceneOfEveryFeatureIsThePictureOfForwardWithEveryTechnique) {
    expectEveryFeature();
}

void LightingInCompute::expectEveryView() {
    const scenes::Scene scene = test::isWholeSweep() ? test::everythingScene() : test::metalScene();
    engine::Renderer renderer(context(), scene);
    std::size_t turn = 0, channels = 0, lit = 0;
    for (const frame::DebugViewInfo& view : frame::debugViewTable()) {
        if (!test::isWholeSweep() && (view.needsGBuffer ? channels : lit)++ % 6 != 0) continue;
        for (const frame::LayoutInfo& layout : test::inTurn(frame::layoutTable(), view.needsGBuffer ? 0 : turn++)) {
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
