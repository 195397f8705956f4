// The viewer's report of the lights that a pixel visits.
#include "viewer/show/PictureLights.h"

#include <set>

#include "tests/image/AreaLightTest.h"
#include "tests/image/ImageTest.h"
#include "viewer/session/Inspection.h"

namespace tessera {
namespace {

using culling::Method;
using engine::Technique;
using viewer::PictureLights;
using namespace test;

struct ListCase {
    Technique technique;
    std::optional<Method> method;
    bool culls = true;
};
constexpr ListCase kListCases[] = {{Technique::Forward, {}, false},
                                   {Technique::Deferred, {}, false},
                                   {Technique::TiledDeferred, Method::Tile25d},
                                   {Technique::ForwardPlus, Method::TileMinmax},
                                   {Technique::ClusteredDeferred, Method::Zbin},
                                   {Technique::ClusteredForward, Method::Cluster}};

class CountedPictureLights : public ImageTest {
protected:
    using NearestSurfaces = std::vector<std::optional<viewer::InspectedSurface>>;

    static engine::ViewRequest request(Technique technique, frame::DebugView view, std::optional<Method> method = {}) {
        engine::ViewRequest requested{technique, {}};
        requested.settings.sizePixels = {150, 85}; // with partial tiles
        requested.settings.view = view;
        requested.settings.culling.method = method;
        return requested;
    }

    /// Nearest surfaces by pixel, rows from the top, transparent ones too, with the fields that visitsOf() reads.
    static NearestSurfaces nearestSurfaces(engine::Renderer& renderer, const scenes::Scene& scene) {
        std::vector<viewer::InspectedSurface> ofInstances;
        for (const scenes::Node& node : scene.nodes)
            for (const scenes::MeshInstance& instance : node.instances) {
                const scenes::Material& material = scene.materials[std::size_t(instance.material)];
                viewer::InspectedSurface& surface = ofInstances.emplace_back();
                surface.isTransparent = scenes::isTransparent(material);
                surface.isLit = scenes::infoOf(material.model).isLit;
            }
        engine::ViewRequest requested = request(Technique::Forward, frame::DebugView::Ids);
        requested.settings.idsOfNearest = true;
        renderer.draw({&requested, 1});
        const engine::RenderedFrame ids = renderer.download();
        NearestSurfaces surfaces(ids.radiance.size() / 4);
        for (std::size_t pixel = 0; pixel < surfaces.size(); ++pixel) {
            const auto instance = std::size_t(ids.radiance[4 * pixel]); // counted from 1
            if (instance > 0) surfaces[pixel] = ofInstances.at(instance - 1);
        }
        return surfaces;
    }

    /// Compares with `shown`, an image of the view `lights`.
    static void expectShown(const PictureLights& lights, const engine::RenderedFrame& shown,
                            const NearestSurfaces& surfaces, bool culls) {
        std::set<std::size_t> counts;
        int wrong = 0, bare = 0, transparent = 0, unlit = 0;
        for (int y = 0; y < shown.height; ++y)
            for (int x = 0; x < shown.width; ++x) {
                const std::size_t pixel = std::size_t(y) * std::size_t(shown.width) + std::size_t(x);
                const std::optional<viewer::InspectedSurface>& surface = surfaces[pixel];
                const std::optional<std::size_t> ofOpaque = lights.visitedAt({x, y});
                if (!surface) {
                    ++bare;
                    wrong += ofOpaque.has_value();
                    continue;
                }
                const std::optional<std::size_t> visited = viewer::visitsOf(*surface, ofOpaque);
                if (surface->isTransparent) {
                    ++transparent;
                    wrong += visited.has_value();
                    continue;
                }
                wrong += !visited || float(*visited) != shown.radiance[4 * pixel];
                unlit += !surface->isLit;
                if (visited && surface->isLit) counts.insert(*visited);
            }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(bare, 0);
        EXPECT_GT(transparent, 0);
        EXPECT_GT(unlit, 0);
        EXPECT_EQ(counts.size() > 1, culls);
    }
};

TEST_F(CountedPictureLights, aPixelOfTheLitPictureVisitsAsManyAsTheViewOfLightsShows) {
    scenes::Scene scene = latticeOf(256);
    scene.lights.push_back(pointLight({0.0, 0.0, 0.0}, 1.0f)); // one that reaches everywhere
    scene.lights.front().enabled = false;
    engine::Renderer renderer(context(), scene);
    for (const auto& [technique, method, culls] : kListCases) {
        SCOPED_TRACE(infoOf(technique).name);
        const engine::ViewRequest lit = request(technique, frame::DebugView::Final, method);
        ASSERT_TRUE(PictureLights::areCounted(lit));
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

/// In a short sweep Lambert materials, and the lit image with one technique: compilation takes most of the time, and
/// lists do not depend on lobes.
TEST_SWEEP(CountedPictureLights, ofLightsOfEveryTypeOnlyOpaqueSurfacesReportTheirVisits) {
    const scenes::Scene scene = withAreaLights(isWholeSweep() ? everythingScene() : lambertScene());
    engine::Renderer renderer(context(), scene);
    const NearestSurfaces surfaces = nearestSurfaces(renderer, scene);
    for (const auto& [technique, method, culls] : kListCases) {
        SCOPED_TRACE(infoOf(technique).name);
        const engine::ViewRequest counted = request(technique, frame::DebugView::Lights, method);
        ASSERT_TRUE(PictureLights::areCounted(counted));
        renderer.draw({&counted, 1});
        const engine::RenderedFrame shown = renderer.download();
        expectShown(PictureLights(renderer), shown, surfaces, culls);
        if (!isWholeSweep() && technique != Technique::ClusteredForward) continue;
        SCOPED_TRACE("the lit picture");
        const engine::ViewRequest lit = request(technique, frame::DebugView::Final, method);
        renderer.draw({&lit, 1});
        expectShown(PictureLights(renderer), shown, surfaces, culls);
    }
}

TEST_F(CountedPictureLights, nothingIsReportedWhereNoListSaysIt) {
    EXPECT_FALSE(PictureLights::areCounted(request(Technique::DeferredVolumes, frame::DebugView::Final)))
        << "volumes choose their pixels as they are rasterised";
    EXPECT_FALSE(PictureLights::areCounted(request(Technique::ForwardPlus, frame::DebugView::Normal)));
    EXPECT_FALSE(PictureLights::areCounted(request(Technique::ForwardPlus, frame::DebugView::Ids)));
    engine::ViewRequest multisampled = request(Technique::ForwardPlus, frame::DebugView::Final);
    multisampled.settings.samples = 4;
    EXPECT_FALSE(PictureLights::areCounted(multisampled)) << "a pixel may show several surfaces";
}

} // namespace
} // namespace tessera
