// Each view of a frame of several views has the image of a frame of its own.

#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "passes/StoredChannelPass.h"
#include "renderer/gpu/Commands.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using View = engine::ViewRequest;
using engine::Technique;
using namespace test;

class SeveralViews : public ImageTest {
protected:
    /// The scene with a second camera at another place, which shows another part of it.
    static scenes::Scene withTwoCameras(scenes::Scene scene) {
        scenes::Camera other = scene.cameras.front();
        other.worldFromCamera[3] += glm::dvec4(0.7, 0.3, 0.5, 0.0);
        other.worldFromCamera =
            other.worldFromCamera * glm::dmat4(glm::dvec4(0.8, 0.0, -0.6, 0.0), glm::dvec4(0.0, 1.0, 0.0, 0.0),
                                               glm::dvec4(0.6, 0.0, 0.8, 0.0), glm::dvec4(0, 0, 0, 1));
        scene.cameras.push_back(other);
        return scene;
    }

    static View view(Technique technique, int camera, glm::ivec2 sizePixels) {
        View view{technique, {}};
        view.settings.camera = camera;
        view.settings.sizePixels = sizePixels;
        return view;
    }

    /// Draws the views in one frame, then each in a separate frame.
    void expectEqual(const scenes::Scene& scene, const std::vector<View>& views) {
        engine::Renderer together(context(), scene), alone(context(), scene);
        together.draw(views);
        for (std::size_t i = 0; i < views.size(); ++i) {
            SCOPED_TRACE(fmt::format("view {}, {}", i, engine::infoOf(views[i].technique).name));
            const engine::RenderedFrame truth = alone.render(views[i].technique, views[i].settings);
            const engine::RenderedFrame drawn = together.download(i);
            EXPECT_EQ(drawn.width, views[i].settings.sizePixels.x);
            EXPECT_TRUE(drawn.radiance == truth.radiance);
            EXPECT_TRUE(drawn.display == truth.display);
            if (views[i].settings.samples == 1) {
                EXPECT_TRUE(together.downloadDepth(i) == alone.downloadDepth());
            }
            EXPECT_TRUE(together.downloadLists(i).lists.entries == alone.downloadLists().lists.entries);
            EXPECT_GT(std::count_if(truth.radiance.begin(), truth.radiance.end(), [](float v) { return v > 0.0f; }),
                      std::ptrdiff_t(truth.radiance.size() / 8))
                << "there is something to see";
        }
    }
};

/// A plain scene with all techniques, and a scene of everything with all of them or with two.
TEST_SWEEP(SeveralViews, twoCamerasInOneFrameAreTwoFramesToTheLastBit) {
    scenes::LoadOptions options;
    options.lights = 200;
    const scenes::Scene plain = withTwoCameras(scenes::loadScene("lattice", options));
    const scenes::Scene everything = withTwoCameras(everythingScene());
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        const std::vector<View> views{view(info.technique, 0, {97, 55}), view(info.technique, 1, {97, 55})};
        expectEqual(plain, views);
        if (isWholeSweep() || info.technique == Technique::Deferred || info.technique == Technique::ClusteredForward)
            expectEqual(everything, views);
    }
}

TEST_SWEEP(SeveralViews, viewsMayDifferInTechniqueSizeSamplesAndWhoBuildsTheirLists) {
    const scenes::Scene scene = withTwoCameras(isWholeSweep() ? everythingScene() : metalScene());
    View alone = view(Technique::ClusteredDeferred, 0, {64, 48});
    alone.settings.culling.builder = culling::Builder::Compute;
    alone.settings.culling.lanes = 1;
    View compute = view(Technique::ForwardPlus, 1, {97, 55});
    compute.settings.culling.builder = culling::Builder::Compute;
    compute.settings.samples = 4;
    View zbin = view(Technique::ClusteredForward, 0, {33, 90});
    zbin.settings.culling.method = culling::Method::Zbin;
    View volumes = view(Technique::DeferredVolumes, 1, {64, 48});
    volumes.settings.space = frame::LightingSpace::View;
    expectEqual(scene, {alone, compute, zbin, volumes});
}

TEST_F(SeveralViews, eachViewsListsAreCulledByItsOwnNormals) {
    scenes::LoadOptions options;
    options.lights = 200;
    const scenes::Scene scene = withTwoCameras(scenes::loadScene("lattice", options));
    std::vector<View> views{view(Technique::ClusteredDeferred, 0, {97, 55}),
                            view(Technique::ClusteredDeferred, 1, {64, 48}),
                            view(Technique::TiledDeferred, 1, {97, 55})};
    for (View& each : views) {
        each.settings.culling.builder = culling::Builder::Cpu;
        each.settings.culling.normals = culling::NormalTest::On;
    }
    views[1].settings.culling.normals = culling::NormalTest::Off;
    expectEqual(scene, views);
}

TEST_F(SeveralViews, aDrawnFrameSharesMemoryAsItsPlanSays) {
    const scenes::Scene scene = withTwoCameras(scenes::loadScene("hall"));
    const std::vector<View> views{view(Technique::Deferred, 0, {96, 54}), view(Technique::Deferred, 1, {96, 54})};
    engine::Renderer renderer(context(), scene);
    renderer.draw(views);
    const graph::Plan plan = engine::planViews(scene, views);
    ASSERT_LT(plan.bytes, plan.bytesWithoutAliasing);
    EXPECT_GE(renderer.backend().poolBytes(), plan.bytes);
    EXPECT_LT(renderer.backend().poolBytes(), plan.bytesWithoutAliasing);
}

TEST_SWEEP(SeveralViews, sharedMemoryChangesNoBit) {
    // Without pruning no memory is shared within a frame, and nothing is left out.
    const scenes::Scene scene = withTwoCameras(scenes::loadScene("hall"));
    const Technique other = isWholeSweep() ? Technique::TiledDeferred : Technique::Deferred;
    std::vector<View> views{view(Technique::Deferred, 0, {96, 54}), view(other, 1, {96, 54})};
    engine::Renderer renderer(context(), scene);
    renderer.draw(views);
    const std::size_t bytes = engine::planViews(scene, views).bytes;
    const std::vector<float> first = renderer.download(0).radiance, second = renderer.download(1).radiance;
    for (View& each : views) each.settings.prune = false;
    renderer.draw(views);
    EXPECT_TRUE(renderer.download(0).radiance == first);
    EXPECT_TRUE(renderer.download(1).radiance == second);
    EXPECT_LT(bytes, engine::planViews(scene, views).bytes);
}

/// Normals of the G-buffer, read by a pass between opaque and transparent surfaces.
class BetweenOpaqueAndTransparent : public ImageTest {
protected:
    std::vector<float> normals(const scenes::Scene& scene, Technique technique, int samples) {
        frame::FrameSettings settings = withSamples(ofSize(97, 55), samples);
        engine::Renderer renderer(context(), scene);
        graph::TextureHandle shown;
        const auto show = [&](graph::Graph& in, std::size_t, const frame::FrameSpec& of,
                              const engine::OpaquePicture& opaque) {
            const frame::StoredComponents normal{frame::Channel::Normal, false};
            shown = passes::StoredChannelPass::add(in, of, {normal}, {opaque.gbuffer.value()}).radiance;
            in.output(shown);
            return opaque.radiance;
        };
        const View view{technique, settings};
        renderer.draw({&view, 1}, {true, show});
        return renderer.texture(shown).downloadAs<float>();
    }
};

TEST_F(BetweenOpaqueAndTransparent, aPersistentTextureIsWrittenInTheFirstFrameOnly) {
    const scenes::Scene scene = scenes::loadScene("room");
    engine::Renderer renderer(context(), scene);
    const graph::TextureDesc desc{graph::Format::Rgba32Float, 4, 4};
    struct Written {
        graph::TextureHandle history;
    };
    int writes = 0;
    graph::TextureHandle shown;
    const auto add = [&](graph::Graph& in, std::size_t index, const frame::FrameSpec&,
                         const engine::OpaquePicture& opaque) {
        EXPECT_EQ(index, std::size_t(0));
        shown = in.persist("history", desc, 1);
        if (!in.holds(shown)) {
            const auto setup = [&](graph::PassBuilder& pass, Written& out) { out.history = pass.write(shown); };
            const auto clear = [](const Written&, const graph::PassContext& drawing) {
                drawing.bindTargets();
                gpu::clearColor(0, glm::vec4(5.0f));
            };
            shown = in.addPass<Written>("history", setup, clear).history;
            ++writes;
        }
        in.output(shown);
        return opaque.radiance;
    };
    frame::FrameSettings settings = ofSize(16, 9);
    const View view{Technique::Deferred, settings};
    for (int frame = 0; frame < 3; ++frame) {
        renderer.draw({&view, 1}, {false, add});
        EXPECT_EQ(renderer.texture(shown).downloadAs<float>().front(), 5.0f);
    }
    EXPECT_EQ(writes, 1);
    EXPECT_EQ(engine::planViews(scene, {&view, 1}, {false, add}).passes.size(),
              engine::planViews(scene, {&view, 1}).passes.size() + 1);
}

TEST_F(BetweenOpaqueAndTransparent, afterAFrameThatFailedThereIsNoneToRead) {
    const scenes::Scene scene = scenes::loadScene("room");
    engine::Renderer renderer(context(), scene);
    EXPECT_THROW(renderer.download(), std::logic_error);
    frame::FrameSettings settings = ofSize(16, 9);
    const engine::RenderedFrame good = renderer.render(Technique::Deferred, settings);
    const auto fail = [](graph::Graph& in, std::size_t, const frame::FrameSpec&, const engine::OpaquePicture& opaque) {
        in.output(graph::TextureHandle{});
        return opaque.radiance;
    };
    const View view{Technique::Deferred, settings};
    EXPECT_ANY_THROW(renderer.draw({&view, 1}, {false, fail}));
    EXPECT_TRUE(renderer.download().radiance == good.radiance) << "a frame that is refused before it is drawn";
    EXPECT_TRUE(renderer.render(Technique::Deferred, settings).radiance == good.radiance);
}

TEST_SWEEP(BetweenOpaqueAndTransparent, everyTechniqueHandsOnTheSameNormalsToTheLastBit) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    const std::vector<float> truth = normals(scene, Technique::Deferred, 1);
    // Normals along an axis have zeros.
    EXPECT_GT(std::ranges::count_if(truth, [](float v) { return v != 0.0f; }), std::ptrdiff_t(truth.size() / 3));
    for (const Technique technique : techniquesInTurn(1))
        EXPECT_TRUE(normals(scene, technique, 1) == truth) << engine::infoOf(technique).name;
    // With several samples, a fragment has the normal at the centre of those that it covers.
    const std::vector<float> several = normals(scene, Technique::Forward, 4);
    for (const Technique technique : techniquesInTurn(0, 4))
        EXPECT_TRUE(normals(scene, technique, 4) == several) << engine::infoOf(technique).name << ", 4 samples";
}

TEST_F(SeveralViews, viewsThatNeedTheSceneInTwoWaysAreRefused) {
    const scenes::Scene scene = withTwoCameras(everythingScene());
    std::vector<View> views{view(Technique::Deferred, 0, {8, 8}), view(Technique::Deferred, 1, {8, 8})};
    views[1].settings.filter = frame::TextureFilter::Exact;
    engine::Renderer renderer(context(), scene);
    EXPECT_THROW(renderer.draw(views), InputError);
}

} // namespace
} // namespace tessera
