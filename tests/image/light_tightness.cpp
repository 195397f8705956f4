// How many lights too many lists hold at most: culling that says yes too often is sound, and only counting sees it.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "tests/support/GlContext.h"
#include "tests/support/ShaderMutant.h"
#include "validation/culling/LightOracle.h"

namespace tessera {
namespace {

using culling::Method;
using engine::Technique;

scenes::Scene lattice() {
    scenes::LoadOptions options;
    options.lights = 1024;
    return scenes::loadScene("lattice", options);
}

/// The lattice's lights as spots that point anywhere.
scenes::Scene latticeOfSpots() {
    scenes::Scene scene = lattice();
    const double count = double(scene.lights.size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        scenes::Light& light = scene.lights[i];
        const double y = 1.0 - 2.0 * (double(i) + 0.5) / count, radius = std::sqrt(1.0 - y * y);
        const double turn = double(i) * std::numbers::pi * (3.0 - std::sqrt(5.0));
        light.type = scenes::LightType::Spot;
        light.directionWS = glm::normalize(glm::dvec3(radius * std::cos(turn), y, radius * std::sin(turn)));
        light.innerConeRadians = 0.0f;
        light.outerConeRadians = float(std::numbers::pi / 9.0);
        light.rangeMetres = 4.0f;
    }
    return scene;
}

/// Visited over needed pairs, at 640x360 with tiles of 16 pixels.
struct Bar {
    Method method;
    double lattice, spots; ///< at most: the measured value (Mesa 22.3.6) plus 2 %
};
constexpr Bar kBars[] = {{Method::TileMinmax, 1.719 * 1.02, 5.377 * 1.02},
                         {Method::Tile25d, 1.653 * 1.02, 4.209 * 1.02},
                         {Method::Cluster, 1.282 * 1.02, 2.240 * 1.02},
                         {Method::Zbin, 1.985 * 1.02, 14.18 * 1.02}};

struct LooseTest {
    const char* fault;
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
    bool ofSpots; ///< the scene whose bar must see it
    Method method;
};
constexpr LooseTest kLooseTests[] = {
    {"cones are not tested", "shared/culling.h", "return beyond <= radius;", "return true;", true, Method::Cluster},
    {"slices of depth twice as deep", "lib/lists/list_depths.glsl", "lighting.slices.x, LIGHT_TILE_SLICES",
     "lighting.slices.x + 1u, LIGHT_TILE_SLICES", false, Method::Cluster},
    {"16 bins of depth", "lib/lists/list_scan.glsl", "ZBIN_COUNT)", "16u)", false, Method::Zbin},
};

class LightTightness : public test::GlTest {
protected:
    double tightness(engine::Renderer& renderer, Method method, culling::Builder builder) {
        frame::FrameSettings settings;
        settings.sizePixels = {640, 360};
        settings.culling.method = method;
        settings.culling.tilePixels = 16;
        settings.culling.builder = builder;
        settings.culling.normals = culling::NormalTest::Off;
        const bool tiled = method == Method::TileMinmax || method == Method::Tile25d;
        const validation::LightOracleFigures figures = validation::judgeLights(
            renderer, tiled ? Technique::TiledDeferred : Technique::ClusteredDeferred, settings);
        EXPECT_EQ(figures.falseNegatives, 0u);
        return figures.tightness().value();
    }
};

TEST_F(LightTightness, everyMethodMeetsItsTightnessTolerance) {
    for (const bool ofSpots : {false, true}) {
        const scenes::Scene scene = ofSpots ? latticeOfSpots() : lattice();
        engine::Renderer renderer(context(), scene);
        for (const Bar& bar : kBars) {
            const double found = tightness(renderer, bar.method, culling::Builder::Cpu);
            const double most = ofSpots ? bar.spots : bar.lattice;
            fmt::print("{}, {}: {:.3f}, at most {:.3f}\n", ofSpots ? "spots" : "lattice", infoOf(bar.method).name,
                       found, most);
            EXPECT_LE(found, most) << infoOf(bar.method).name;
        }
    }
}

/// Shaders that build lists with one fault each, all of them sound.
TEST_F(LightTightness, aTooLooseTestMissesATightnessTolerance) {
    for (const LooseTest& loose : kLooseTests) {
        SCOPED_TRACE(loose.fault);
        const test::ShaderMutant shaders;
        shaders.replace(loose.file, loose.from, loose.to);
        const scenes::Scene scene = loose.ofSpots ? latticeOfSpots() : lattice();
        engine::Renderer renderer(context(), scene, shaders.tree());
        const double found = tightness(renderer, loose.method, culling::Builder::Compute);
        for (const Bar& bar : kBars) {
            if (bar.method != loose.method) continue;
            const double most = loose.ofSpots ? bar.spots : bar.lattice;
            fmt::print("{}: {:.3f}, at most {:.3f}\n", loose.fault, found, most);
            EXPECT_GT(found, most);
        }
    }
}

} // namespace
} // namespace tessera
