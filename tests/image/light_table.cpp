// The whole table of light culling: every method at every tile size, on scenes of different depth.
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <map>
#include <numbers>
#include <span>

#include "tests/image/ImageTest.h"
#include "tests/support/CullingScenes.h"
#include "tests/support/LightTable.h"
#include "tests/support/ShaderMutant.h"
#include "validation/culling/LightOracle.h"

namespace tessera {
namespace {

using culling::Method;
using Evaluated = std::map<std::pair<Method, int>, double>;
using engine::Technique;
using namespace test;

class LightTable : public ImageTest {
protected:
    /// Prints the table and returns the evaluated pairs. TESSERA_TABLE_FULL selects full-size images.
    Evaluated judge(const scenes::Scene& scene, std::span<const int> tileSides = culling::kTileSides) {
        frame::FrameSettings settings;
        settings.sizePixels =
            std::getenv("TESSERA_TABLE_FULL") != nullptr ? glm::ivec2(1280, 720) : glm::ivec2(321, 179);
        settings.culling.normals = culling::NormalTest::Off;
        engine::Renderer renderer(context(), scene);
        const std::vector<validation::LightTableRow> rows = validation::judgeCulling(renderer, settings, tileSides);
        fmt::print("{}, {} lights, {}x{}: {}\n", scene.name, scene.lights.size(), settings.sizePixels.x,
                   settings.sizePixels.y, validation::lightTable(rows));
        EXPECT_EQ(rows.size(), 1 + 4 * tileSides.size());
        Evaluated evaluated;
        for (const validation::LightTableRow& row : rows) {
            SCOPED_TRACE(fmt::format("method {}, tile {}", int(row.method), row.tilePixels));
            EXPECT_EQ(row.figures.falseNegatives, 0u);
            EXPECT_GT(row.figures.needed, 0u);
            EXPECT_EQ(row.figures.covered, rows[0].figures.covered);
            EXPECT_EQ(row.figures.needed, rows[0].figures.needed) << "what is needed has nothing to do with the method";
            EXPECT_EQ(row.figures.neededLit, rows[0].figures.neededLit);
            EXPECT_GE(row.figures.evaluated, row.figures.needed);
            evaluated[{row.method, row.tilePixels}] = double(row.figures.evaluated);
        }
        return evaluated;
    }
    /// With every tile size, or with the given ones.
    void judgeSome(const scenes::Scene& scene, std::initializer_list<int> tileSides) {
        judge(scene, isWholeSweep() ? std::span<const int>(culling::kTileSides) : std::span<const int>(tileSides));
    }
};

TEST_SWEEP(LightTable, everyMethodAndTileIsSoundOnTheLattice) {
    judgeSome(latticeOf(1024), {8, 64});
}

TEST_SWEEP(LightTable, everyMethodAndTileIsSoundInTheHall) {
    judgeSome(scenes::loadScene("hall"), {16});
}

TEST_F(LightTable, everyMethodAndTileIsSoundInSponza) {
    const char* folder = std::getenv("TESSERA_ASSETS");
    const std::filesystem::path model = std::filesystem::path(folder == nullptr ? "" : folder) / "Sponza/Sponza.gltf";
    if (!std::filesystem::exists(model)) GTEST_SKIP() << "TESSERA_ASSETS has no Sponza/Sponza.gltf";
    Evaluated evaluated = judge(litFromWithin(scenes::loadScene(model.string()), 512, 2.5f));
    EXPECT_GT((evaluated[{Method::TileMinmax, 16}]), (evaluated[{Method::Cluster, 16}]))
        << "a view without depth judges nothing";
}

/// At every tile size, or every other; LightCulling.depthSlicesPayWhereDepthHasDeepGaps covers the usual one.
TEST_SWEEP(LightTable, depthSlicesPayAtEveryTileSideWhereDepthHasDeepGaps) {
    const std::vector<int> tileSides =
        everyNth(std::vector(std::begin(culling::kTileSides), std::end(culling::kTileSides)), 2);
    Evaluated evaluated = judge(columnsBeforeWall(1500), tileSides);
    for (const int tile : tileSides) {
        SCOPED_TRACE(tile);
        // The limit of the comparison at tile 16; larger tiles span more of the gaps, smaller ones fewer.
        const double bar = tile >= 16 ? 1.5 : 1.0;
        const auto pairs = [&](Method method) { return evaluated[{method, tile}]; };
        EXPECT_GE(pairs(Method::TileMinmax), bar * pairs(Method::Tile25d));
        EXPECT_GE(pairs(Method::TileMinmax), bar * pairs(Method::Cluster));
    }
}

// How many unneeded lights lists may hold: culling that is too conservative is sound, and only counting detects it.

/// The lattice's lights as spots in all directions.
scenes::Scene latticeOfSpots() {
    scenes::Scene scene = latticeOf(1024);
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
    bool ofSpots; ///< the scene whose limit must detect it
    Method method;
};
constexpr LooseTest kLooseTests[] = {
    {"cones are not tested", "shared/culling.h", "return beyond <= radius;", "return true;", true, Method::Cluster},
    {"slices of depth twice as deep", "lib/lists/list_depths.glsl", "lighting.slices.x, LIGHT_TILE_SLICES",
     "lighting.slices.x + 1u, LIGHT_TILE_SLICES", false, Method::Cluster},
    {"16 bins of depth", "lib/lists/list_scan.glsl", "ZBIN_COUNT)", "16u)", false, Method::Zbin},
};

class LightTightness : public ImageTest {
protected:
    double tightness(engine::Renderer& renderer, Method method, culling::Builder builder) {
        frame::FrameSettings settings = ofSize(640, 360);
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
        const scenes::Scene scene = ofSpots ? latticeOfSpots() : latticeOf(1024);
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

/// Shaders that build lists with one fault each, none of which misses a light.
TEST_F(LightTightness, aTooLooseTestMissesATightnessTolerance) {
    for (const LooseTest& loose : kLooseTests) {
        SCOPED_TRACE(loose.fault);
        const ShaderMutant shaders(loose.file, loose.from, loose.to);
        const scenes::Scene scene = loose.ofSpots ? latticeOfSpots() : latticeOf(1024);
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
