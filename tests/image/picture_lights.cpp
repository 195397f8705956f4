// What the viewer tells of the lights that a pixel visits.
#include "viewer/show/PictureLights.h"

#include <optional>
#include <set>

#include "scenes/Load.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using culling::Method;
using engine::Technique;
using viewer::PictureLights;

class PictureLightsTold : public test::GlTest {
protected:
    static engine::ViewRequest request(Technique technique, frame::DebugView view, std::optional<Method> method = {}) {
        engine::ViewRequest asked{technique, {}};
        asked.settings.sizePixels = {150, 85}; // of tiles that are cut off
        asked.settings.view = view;
        asked.settings.culling.method = method;
        return asked;
    }
};

TEST_F(PictureLightsTold, aPixelOfTheLitPictureVisitsAsManyAsTheViewOfLightsShows) {
    scenes::LoadOptions options;
    options.lights = 256;
    scenes::Scene scene = scenes::loadScene("lattice", options);
    scene.lights.push_back(test::pointLight({0.0, 0.0, 0.0}, 1.0f)); // one that reaches everywhere
    scene.lights.front().enabled = false;
    engine::Renderer renderer(context(), scene);
    struct Case {
        Technique technique;
        std::optional<Method> method;
        bool culls = true;
    };
    for (const auto& [technique, method, culls] : {Case{Technique::Forward, {}, false},
                                                   {Technique::Deferred, {}, false},
                                                   {Technique::TiledDeferred, Method::Tile25d},
                                                   {Technique::ForwardPlus, Method::TileMinmax},
                                                   {Technique::ClusteredDeferred, Method::Zbin},
                                                   {Technique::ClusteredForward, Method::Cluster}}) {
        SCOPED_TRACE(infoOf(technique).name);
        const engine::ViewRequest lit = request(technique, frame::DebugView::Final, method);
        ASSERT_TRUE(PictureLights::areTold(lit));
        renderer.draw({&lit, 1});
        const PictureLights lights(renderer);
        const engine::ViewRequest counted = request(technique, frame::DebugView::Lights, method);
        renderer.draw({&counted, 1});
        const engine::RenderedFrame shown = renderer.download();
        std::set<std::size_t> counts;
        int wrong = 0, bare = 0;
        for (int y = 0; y < shown.height; ++y)
            for (int x = 0; x < shown.width; ++x) {
                const float* const rgba =
                    &shown.radiance[4 * (std::size_t(y) * std::size_t(shown.width) + std::size_t(x))];
                const std::optional<std::size_t> visited = lights.visitedAt({x, y});
                if (rgba[3] > 0.0f ? !visited || float(*visited) != rgba[0] : visited.has_value()) ++wrong;
                if (visited) counts.insert(*visited);
                if (!visited) ++bare;
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(bare, 0) << "no pixel lacks a surface, so nothing was tried there";
        if (culls)
            EXPECT_GT(counts.size(), 10u) << "all pixels visit the same lights, so nothing was tried";
        else
            EXPECT_EQ(counts.size(), 1u);
    }
}

TEST_F(PictureLightsTold, nothingIsToldWhereNoListSaysIt) {
    EXPECT_FALSE(PictureLights::areTold(request(Technique::DeferredVolumes, frame::DebugView::Final)))
        << "volumes choose their pixels as they are rasterised";
    EXPECT_FALSE(PictureLights::areTold(request(Technique::ForwardPlus, frame::DebugView::Normal)));
    EXPECT_FALSE(PictureLights::areTold(request(Technique::ForwardPlus, frame::DebugView::Ids)));
    engine::ViewRequest multisampled = request(Technique::ForwardPlus, frame::DebugView::Final);
    multisampled.settings.samples = 4;
    EXPECT_FALSE(PictureLights::areTold(multisampled)) << "a pixel may show several surfaces";
}

} // namespace
} // namespace tessera
