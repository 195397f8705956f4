// The whole table of light culling: every method at every tile side, on scenes of different depth.
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <map>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "scenes/Load.h"
#include "tests/support/CullingScenes.h"
#include "tests/support/GlContext.h"
#include "tests/support/Sweep.h"
#include "validation/culling/LightTable.h"

namespace tessera {
namespace {

using culling::Method;
using Evaluated = std::map<std::pair<Method, int>, double>;

class LightTable : public test::GlTest {
protected:
    /// Prints the table and returns the pairs evaluated. TESSERA_TABLE_FULL asks for figures of full pictures.
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
    /// With every tile side, or with some.
    void judgeSome(const scenes::Scene& scene, std::initializer_list<int> tileSides) {
        judge(scene,
              test::isWholeSweep() ? std::span<const int>(culling::kTileSides) : std::span<const int>(tileSides));
    }
    void judgeLattice() {
        scenes::LoadOptions options;
        options.lights = 1024;
        judgeSome(scenes::loadScene("lattice", options), {8, 64});
    }
    void judgeHall() { judgeSome(scenes::loadScene("hall"), {16}); }
    void expectDepthSlicesPay();
};
using LightTableSlow = LightTable;

TEST_F(LightTable, everyMethodAndTileIsSoundOnTheLattice) {
    judgeLattice();
}
TEST_F(LightTableSlow, everyMethodAndTileIsSoundOnTheLattice) {
    judgeLattice();
}

TEST_F(LightTable, everyMethodAndTileIsSoundInTheHall) {
    judgeHall();
}
TEST_F(LightTableSlow, everyMethodAndTileIsSoundInTheHall) {
    judgeHall();
}

TEST_F(LightTable, everyMethodAndTileIsSoundInSponza) {
    const char* folder = std::getenv("TESSERA_ASSETS");
    const std::filesystem::path model = std::filesystem::path(folder == nullptr ? "" : folder) / "Sponza/Sponza.gltf";
    if (!std::filesystem::exists(model)) GTEST_SKIP() << "TESSERA_ASSETS has no Sponza/Sponza.gltf";
    Evaluated evaluated = judge(test::litFromWithin(scenes::loadScene(model.string()), 512, 2.5f));
    EXPECT_GT((evaluated[{Method::TileMinmax, 16}]), (evaluated[{Method::Cluster, 16}]))
        << "a view without depth judges nothing";
}

/// At every tile side, or at every other one; LightCulling.depthSlicesPayWhereDepthHasDeepGaps has the usual one.
void LightTable::expectDepthSlicesPay() {
    const std::vector<int> tileSides =
        test::everyNth(std::vector(std::begin(culling::kTileSides), std::end(culling::kTileSides)), 2);
    Evaluated evaluated = judge(test::columnsBeforeWall(1500), tileSides);
    for (const int tile : tileSides) {
        SCOPED_TRACE(tile);
        // The bar of the comparison at tile 16; larger tiles span more of the gaps, smaller ones fewer.
        const double bar = tile >= 16 ? 1.5 : 1.0;
        const auto pairs = [&](Method method) { return evaluated[{method, tile}]; };
        EXPECT_GE(pairs(Method::TileMinmax), bar * pairs(Method::Tile25d));
        EXPECT_GE(pairs(Method::TileMinmax), bar * pairs(Method::Cluster));
    }
}
TEST_F(LightTable, depthSlicesPayAtEveryTileSideWhereDepthHasDeepGaps) {
    expectDepthSlicesPay();
}
TEST_F(LightTableSlow, depthSlicesPayAtEveryTileSideWhereDepthHasDeepGaps) {
    expectDepthSlicesPay();
}

} // namespace
} // namespace tessera
