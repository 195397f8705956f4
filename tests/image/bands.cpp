#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Texture.h"
#include "renderer/graph/Execute.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using namespace test;

class Bands : public ImageTest {
protected:
    static frame::FrameSettings small() {
        return ofSize(200, 211); // four bands, the last one cropped
    }
};

TEST_SWEEP(Bands, aPictureDrawnInBandsIsExactlyTheSameWithEveryTechnique) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    engine::Renderer renderer(context(), scene);
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        SCOPED_TRACE(info.name);
        const engine::RenderedFrame whole = renderer.render(info.technique, small());
        int calls = 0;
        const gpu::BandedDrawing banded([&calls] {
            ++calls;
            return false;
        });
        const engine::RenderedFrame pieces = renderer.render(info.technique, small());
        EXPECT_EQ(pieces.radiance, whole.radiance);
        EXPECT_EQ(pieces.display, whole.display);
        EXPECT_GT(calls, 4); // after every pass, and between bands
    }
}

TEST_F(Bands, aPictureDrawnInTheSmallestPiecesIsExactlyTheSame) {
    const scenes::Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(75, 51); // pieces of 16 pixels, the last one cropped
    for (const engine::Technique technique : {engine::Technique::Forward, engine::Technique::TiledDeferred}) {
        SCOPED_TRACE(infoOf(technique).name);
        const engine::RenderedFrame whole = renderer.render(technique, settings);
        int calls = 0;
        const auto givesUp = [&calls] {
            ++calls;
            return false;
        };
        const gpu::BandedDrawing banded(givesUp, {.beginsSlow = true, .longestMs = 0.0});
        const engine::RenderedFrame pieces = renderer.render(technique, settings);
        EXPECT_EQ(pieces.radiance, whole.radiance);
        EXPECT_EQ(pieces.display, whole.display);
        EXPECT_GT(calls, 20) << "the pieces are not small";
    }
}

TEST_F(Bands, aFrameCanBeAbandonedAtEveryBand) {
    const scenes::Scene scene = scenes::loadScene("lattice");
    engine::Renderer renderer(context(), scene);
    const engine::RenderedFrame before = renderer.render(engine::Technique::TiledDeferred, small());
    bool ended = false;
    for (int last = 0; !ended; ++last) {
        ASSERT_LT(last, 1000) << "the frame never ends";
        int calls = 0;
        const gpu::BandedDrawing banded([&] { return calls++ == last; });
        try {
            renderer.draw(engine::Technique::TiledDeferred, small());
            ended = true;
        } catch (const graph::Interrupted&) {
            EXPECT_EQ(calls, last + 1);
        }
    }
    // Abandoned frames leave nothing behind.
    EXPECT_EQ(renderer.render(engine::Technique::TiledDeferred, small()).radiance, before.radiance);
}

TEST_SWEEP(Bands, itReportsHowFarItIsAndOtherThingsMayBeDrawnInBetween) {
    const scenes::Scene scene = isWholeSweep() ? everythingScene() : metalScene();
    engine::Renderer renderer(context(), scene);
    const gpu::Texture texture("other", graph::TextureDesc{graph::Format::Rgba8Unorm, 16, 16, 1});
    const gpu::Framebuffer other(gpu::Attachments{{&texture}});
    for (const engine::TechniqueInfo& info : engine::techniqueTable()) {
        SCOPED_TRACE(info.name);
        const engine::RenderedFrame whole = renderer.render(info.technique, small());
        std::size_t passes = 0, shares = 0;
        double share = 0.0;
        const gpu::BandedDrawing banded([&] {
            const gpu::BandProgress progress = gpu::bandProgress();
            EXPECT_GE(progress.passes, passes);
            EXPECT_GE(progress.share, 0.0);
            EXPECT_LT(progress.share, 1.0);
            if (progress.passes == passes && progress.share > share) ++shares;
            passes = progress.passes;
            share = progress.share;
            const gpu::BetweenBands between;
            gpu::bindFramebuffer(other);
            gpu::setScissor({3, 3, 5, 5});
            gpu::clearColor(0, {1.0f, 0.0f, 0.0f, 1.0f});
            return false;
        });
        const engine::RenderedFrame pieces = renderer.render(info.technique, small());
        EXPECT_EQ(pieces.radiance, whole.radiance);
        EXPECT_EQ(pieces.display, whole.display);
        EXPECT_GE(passes, renderer.backend().passTimings().size());
        EXPECT_GT(shares, 0u) << "no draw reported its progress";
    }
}

TEST_F(Bands, manyTrianglesAreDrawnInPartsThatLeaveOutNone) {
    const scenes::Scene scene = scenes::loadScene("lattice"); // the parts end within its spheres
    engine::Renderer renderer(context(), scene);
    const engine::RenderedFrame whole = renderer.render(engine::Technique::Deferred, small());
    std::vector<int> calls(renderer.backend().passTimings().size() + 1); // calls within each pass
    const gpu::BandedDrawing banded([&calls] {
        const gpu::BandProgress progress = gpu::bandProgress();
        if (progress.share > 0.0) ++calls.at(progress.passes);
        return false;
    });
    const engine::RenderedFrame pieces = renderer.render(engine::Technique::Deferred, small());
    EXPECT_EQ(pieces.radiance, whole.radiance);
    const std::vector<gpu::PassTiming> passes = renderer.backend().passTimings();
    const auto gbuffer = std::ranges::find(passes, "gbuffer", &gpu::PassTiming::name);
    ASSERT_NE(gbuffer, passes.end());
    // Bands alone would be four: after the first part there are more, each of at most twice the triangles.
    EXPECT_GE(calls[std::size_t(gbuffer - passes.begin())], 5);
}

TEST_F(Bands, withoutBandedDrawingTheCallbackIsNotCalled) {
    const scenes::Scene scene = scenes::loadScene("lattice");
    engine::Renderer renderer(context(), scene);
    int calls = 0;
    {
        const gpu::BandedDrawing banded([&calls] {
            ++calls;
            return false;
        });
    }
    renderer.draw(engine::Technique::Deferred, small());
    EXPECT_EQ(calls, 0);
}

} // namespace
} // namespace tessera
