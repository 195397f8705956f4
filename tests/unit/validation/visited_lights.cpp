#include "validation/culling/VisitedLights.h"

#include <bit>

#include <gtest/gtest.h>

#include "tests/support/LightTable.h"
#include "validation/culling/LightOracle.h"

namespace tessera::validation {
namespace {

using culling::Method;

/// The keys of depths 1/2 and 1 with the bias 1 differ in this bit and higher ones only, so slices of this size
/// separate them.
constexpr std::uint32_t kHalfShift = 22;

/// Hand-written lists for an image of 8 x 16 pixels in two tiles of 8 x 8. The GPU has four of five lights: all but the
/// scene's light 1.
engine::DrawnLists listsByHand(Method method) {
    engine::DrawnLists drawn;
    drawn.culling.method = method;
    drawn.lighting.tileGrid = {1, 2, 16, 3};
    drawn.view.depthKey.x = 1.0f;
    drawn.sceneIndex = {0, 2, 3, 4};
    return drawn;
}

/// The upper tile has one cell, with lights 0 and 2 of the lists; the lower one has depth slices, of which two hold a
/// surface: that of depth 1/2 with light 1, and that of depth 1 with lights 0 and 1.
engine::DrawnLists runsByHand() {
    engine::DrawnLists drawn = listsByHand(Method::Tile25d);
    const std::uint32_t first = std::bit_cast<std::uint32_t>(1.5f) - (1u << kHalfShift);
    drawn.lists.tiles.resize(2);
    drawn.lists.tiles[0].words = {0, shared::packSlices(0, 31), 1, 0};
    drawn.lists.tiles[1].words = {1, shared::packSlices(first, kHalfShift), 0b110, 0};
    drawn.lists.cells = {{0, 2}, {2, 1}, {3, 2}};
    drawn.lists.entries = {0, 2, 1, 0, 1};
    return drawn;
}

std::vector<int> visited(const engine::DrawnLists& drawn, int row, float depth) {
    const VisitedLights lights(drawn);
    std::vector<int> sceneLights;
    lights.at(lights.cellAt(3, row, depth), sceneLights);
    return sceneLights;
}

using Lights = std::vector<int>;

TEST(VisitedLights, aPixelVisitsTheRunOfItsTileAndSlice) {
    const engine::DrawnLists drawn = runsByHand();
    EXPECT_EQ(visited(drawn, 15, 0.5f), (Lights{0, 3})) << "tile rows count from the top, pixel rows from the bottom";
    EXPECT_EQ(visited(drawn, 8, 1.0f), (Lights{0, 3}));
    EXPECT_EQ(visited(drawn, 7, 0.5f), (Lights{2}));
    EXPECT_EQ(visited(drawn, 0, 1.0f), (Lights{0, 2}));
}

TEST(VisitedLights, areInTheOrderOfTheSceneWhateverThatOfTheLists) {
    engine::DrawnLists drawn = runsByHand();
    drawn.sceneIndex = {4, 0, 2, 3}; // as if light 4 alone cast shadows
    EXPECT_EQ(visited(drawn, 15, 0.5f), (Lights{2, 4}));
    drawn.culling.method = Method::None;
    EXPECT_EQ(visited(drawn, 15, 0.5f), (Lights{0, 2, 3, 4}));
}

TEST(VisitedLights, aSliceOfTheUpperWordFindsItsCell) {
    engine::DrawnLists drawn = runsByHand();
    // Depth 1 falls in slice 40; slices 0, 31 and 32 are occupied too.
    const std::uint32_t high = std::bit_cast<std::uint32_t>(2.0f);
    drawn.lists.tiles[1].words = {1, shared::packSlices(high - (40u << kHalfShift), kHalfShift), 0x80000001u, 0x101u};
    drawn.lists.cells = {{0, 2}, {2, 1}, {2, 1}, {2, 1}, {3, 2}};
    EXPECT_EQ(visited(drawn, 0, 1.0f), (Lights{0, 2})) << "three occupied slices lie below slice 40";
}

TEST(VisitedLights, lightsThatReachEverywhereAreMergedInOrder) {
    engine::DrawnLists drawn = runsByHand();
    drawn.everywhere = {1, 3};
    drawn.lists.entries = {1, 3, 0, 2, 2};
    drawn.lists.cells = {{2, 2}, {4, 1}, {4, 0}};
    EXPECT_EQ(visited(drawn, 15, 0.5f), (Lights{0, 2, 3, 4}));
    EXPECT_EQ(visited(drawn, 0, 1.0f), (Lights{2, 4}));
}

TEST(VisitedLights, aPixelVisitsTheBitsThatItsTileAndBinShare) {
    engine::DrawnLists drawn = listsByHand(Method::Zbin);
    drawn.sceneIndex.clear();
    for (int light = 0; light < 70; ++light) drawn.sceneIndex.push_back(light);
    drawn.lighting.lights.w = 3; // words of 32 lights
    const std::uint32_t first = std::bit_cast<std::uint32_t>(1.5f);
    drawn.lists.tiles.resize(2);
    drawn.lists.tiles[0].words = {6, shared::packSlices(first, kHalfShift), 0, 0};
    drawn.lists.tiles[1].words = {9, shared::packSlices(first, kHalfShift), 0, 0};
    // Two bins' masks, then two tiles'; bin 1 has no bit in its first word, so its range starts at the second.
    drawn.lists.entries = {0b101u, 0x80000000u, 0b1u, 0u, 0b11u, 0b100000u, ~0u, ~0u, ~0u, 0b100u, 0b10u, 0b100000u};
    drawn.lists.cells = {{0, 3}, {1, 3}};
    EXPECT_EQ(visited(drawn, 15, 0.5f), (Lights{0, 2, 63, 64}));
    EXPECT_EQ(visited(drawn, 15, 1.0f), (Lights{32, 33, 69}));
    EXPECT_EQ(visited(drawn, 0, 0.5f), (Lights{2}));
    EXPECT_EQ(visited(drawn, 0, 1.0f), (Lights{33, 69}));
}

TEST(VisitedLights, withoutCullingEveryPixelVisitsEveryLight) {
    EXPECT_EQ(visited(listsByHand(Method::None), 0, 0.5f), (Lights{0, 2, 3, 4}));
}

/// One pixel of the lower tile shows a surface, a metre from all lights; the scene's lights 0 and 2 reach it.
class SabotagedLists : public ::testing::Test {
protected:
    SabotagedLists() : drawn_(runsByHand()), depth_(8 * 16, 0.0f) {
        scenes::Camera camera;
        camera.projection = scenes::Projection::Orthographic;
        camera.nearMetres = 0.0;
        camera.farMetres = 10.0;
        camera.worldFromCamera[3].z = -5.0;
        scene_.cameras.push_back(camera);
        scene_.lights.resize(5);
        for (scenes::Light& light : scene_.lights) {
            light.positionWS = {0.0, 0.0, -5.0};
            light.rangeMetres = 5.0f;
        }
        scene_.lights[1].enabled = false;
        scene_.lights[3].enabled = false;
        scene_.lights[4].rangeMetres = 0.1f;
        settings_.sizePixels = {8, 16};
        drawn_.depths = {camera.nearMetres, camera.farMetres};
        depth_[3] = 1.0f; // the near plane
    }
    LightOracleFigures judge() const { return judgeLights({scene_, settings_, drawn_, depth_, {}}); }

    scenes::Scene scene_;
    frame::FrameSettings settings_;
    engine::DrawnLists drawn_;
    std::vector<float> depth_;
};

TEST_F(SabotagedLists, aRemovedEntryIsNoticedAndNamed) {
    EXPECT_EQ(judge().covered, 1u);
    EXPECT_EQ(judge().needed, 2u);
    EXPECT_EQ(judge().evaluated, 2u);
    EXPECT_EQ(judge().falseNegatives, 0u);
    drawn_.lists.cells.back() = {3, 1};
    EXPECT_EQ(judge().falseNegatives, 1u);
    EXPECT_EQ(judge().evaluated, 1u);
    ASSERT_TRUE(judge().firstMissing);
    EXPECT_EQ(judge().firstMissing->light, 2);
    EXPECT_EQ(judge().firstMissing->x, 3);
    EXPECT_EQ(judge().firstMissing->y, 15);
}

TEST_F(SabotagedLists, anAddedEntryIsCountedAsExactlyOneMore) {
    drawn_.lists.cells.back() = {3, 3};
    drawn_.lists.entries.push_back(3);
    EXPECT_EQ(judge().evaluated, 3u);
    EXPECT_EQ(judge().needed, 2u);
    EXPECT_EQ(judge().falseNegatives, 0u);
    EXPECT_DOUBLE_EQ(*judge().tightness(), 1.5);
    EXPECT_EQ(judge().entries, 6u);
}

TEST_F(SabotagedLists, aRunThatLeavesTheEntriesIsNotRead) {
    drawn_.lists.cells.back() = {3, 3};
    EXPECT_THROW(judge(), std::out_of_range);
}

TEST(CellLights, everyCellCountsExactlyOnce) {
    CellLights some, others;
    EXPECT_EQ(some.figures().count, 0u);
    EXPECT_EQ(some.figures().max, 0u);
    for (int again = 0; again < 3; ++again) some.add({7, 0}, 10);
    some.add({7, 1}, 2);
    others.add({7, 0}, 10);
    others.add({8, 0}, 0);
    some.add(others);
    EXPECT_EQ(some.figures().count, 3u);
    EXPECT_DOUBLE_EQ(some.figures().mean, 4.0);
    EXPECT_EQ(some.figures().p99, 10u);
    EXPECT_EQ(some.figures().max, 10u);
}

TEST(CellLights, thePercentileIsOneOfTheCells) {
    CellLights lights;
    for (std::uint32_t cell = 1; cell <= 200; ++cell) lights.add({cell, 0}, cell);
    EXPECT_EQ(lights.figures().p99, 198u);
    EXPECT_EQ(lights.figures().max, 200u);
}

TEST(LightTable, everyRowShowsItsFiguresAndNothingThatIsNotKnown) {
    LightTableRow row;
    row.method = Method::Tile25d;
    row.tilePixels = 32;
    row.figures.covered = 4;
    row.figures.needed = 8;
    row.figures.evaluated = 18;
    row.figures.everywhere = 4;
    row.figures.evaluatedP99 = 61;
    row.figures.evaluatedMax = 72;
    row.figures.entries = 1234;
    row.figures.listBytes = 56789;
    row.figures.occupied = {33, 12.5, 14, 15};
    const std::string text = lightTable({&row, 1});
    for (const char* part : {"4 covered pixels, each needs 2.00 lights, 0.00", "and 1.00 that reach everywhere",
                             "tile_2.5d      32     5.50     61     72     2.250         -    12.50     14     15"
                             "        33     1234       56789      0\n"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
    EXPECT_EQ(lightTable({}), "");
}

} // namespace
} // namespace tessera::validation
