// Steps that build light lists on the GPU, on chosen numbers: cases for which no test's image is large or deep enough.
#include <bit>

#include <gtest/gtest.h>

#include "renderer/frame/CameraView.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/light_lists.h"
#include "tests/gpu/shaders/ShaderBench.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

/// Eight slices per octave of depth have 2^20 keys each, and 64 lie between 2^-8 and 1.
constexpr std::uint32_t kShiftOfAnEighth = 20;

class ListSteps : public test::GlTest {
protected:
    ListSteps()
        : view_(frame::makeCameraView(scenes::Camera{}, {64, 64}, frame::LightingSpace::World, glm::vec3(0.0f))
                    .constants) {
        lighting_.slices.x = kShiftOfAnEighth;
    }

    static shader::Defines definesOf(const char* method, int lanes) {
        return {{"LIST_METHOD", method},       {"LIST_IN_ROUNDS", "0"},    {"LIST_THREADS", std::to_string(lanes)},
                {"LIST_GROUP", "64"},          {"LIST_LIGHTS_A_ROW", "1"}, {"SAMPLES", "1"},
                {"HAS_TRANSPARENT_LAYER", "0"}};
    }

    /// The totals that the scan writes for a row of tiles, divided among 64 lanes.
    glm::uvec4 scanned(const char* method, std::uint32_t storage, const gpu::Buffer& ofTiles, std::size_t tiles) {
        lighting_.tileGrid = {std::uint32_t(tiles), 1u, 0u, 0u};
        const gpu::Program& program =
            bench_.programs().get({"scan", "", "", "passes/light_scan.glsl", definesOf(method, 64)});
        const gpu::Buffer view = gpu::Buffer::of("view", std::span(&view_, 1));
        const gpu::Buffer lighting = gpu::Buffer::of("lighting", std::span(&lighting_, 1));
        const gpu::Buffer totals("totals", sizeof(glm::uvec4), gpu::BufferUse::Readback);
        gpu::useProgram(program);
        gpu::bindUniformBuffer(UNIFORM_VIEW, view);
        gpu::bindUniformBuffer(UNIFORM_LIGHTING, lighting);
        gpu::bindStorageBuffer(storage, ofTiles);
        gpu::bindStorageBuffer(STORAGE_LIST_TOTALS, totals);
        gpu::dispatch(1);
        gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
        return totals.downloadAs<glm::uvec4>(1).front();
    }

    shared::ViewConstants view_;
    shared::LightingConstants lighting_{};
    test::ShaderBench bench_;
};

TEST_F(ListSteps, firstsAndTotalsAreTheSumsOfTheTilesBeforeBeyondThirtyTwoBits) {
    test::Random random(1);
    lighting_.lights.z = 3; // lights of unlimited range, whose entries come first
    for (const std::size_t tiles : {1, 63, 64, 65, 1000}) {
        SCOPED_TRACE(tiles);
        std::vector<glm::uvec2> counts;
        for (std::size_t i = 0; i < tiles; ++i)
            counts.emplace_back(random.index(65), std::uint32_t(random.unit() * 0x1p32));
        const gpu::Buffer buffer = gpu::Buffer::of("counts", counts);
        const glm::uvec4 totals = scanned("LIST_METHOD_CLUSTER", STORAGE_TILE_COUNTS, buffer, tiles);
        const std::vector<glm::uvec2> firsts = buffer.downloadAs<glm::uvec2>(tiles);
        std::uint32_t cells = 1; // the empty cell
        std::uint64_t entries = lighting_.lights.z;
        for (std::size_t i = 0; i < tiles; ++i) {
            ASSERT_EQ(firsts[i], glm::uvec2(cells, std::uint32_t(entries))) << "tile " << i;
            cells += counts[i].x;
            entries += counts[i].y;
        }
        EXPECT_EQ(totals, glm::uvec4(cells, std::uint32_t(entries), std::uint32_t(entries >> 32), 0u));
    }
}

/// One tile in front of all others and one behind them, each at every position.
TEST_F(ListSteps, binsReachFromTheFarthestToTheNearestTileWhereverTheyAre) {
    constexpr std::size_t kTiles = 130; // three for some lanes, two for the others
    const auto key = [&](float depth) { return std::bit_cast<std::uint32_t>(view_.depthKey.x + depth); };
    const auto bins = [&](float nearest, float farthest) {
        const std::uint32_t slicing = shared::slicingOf(key(farthest), key(nearest), kShiftOfAnEighth, ZBIN_COUNT);
        return glm::uvec4(slicing, shared::sliceOfKey(key(nearest), slicing) + 1u, 0u, 0u);
    };
    for (std::size_t i = 0; i < kTiles; ++i) {
        SCOPED_TRACE(i);
        std::vector<glm::vec2> depths(kTiles, glm::vec2(2e-5f)); // thousands of near-plane distances ahead
        depths[(i + 7) % kTiles] = glm::vec2(0.0f);              // no surface
        depths[i] = {5e-3f, 2e-3f};
        depths[(i + 1) % kTiles] = {1e-5f, 2e-6f};
        EXPECT_EQ(scanned("LIST_METHOD_ZBIN", STORAGE_TILE_DEPTHS, gpu::Buffer::of("depths", depths), kTiles),
                  bins(5e-3f, 2e-6f));
    }
    const std::vector<glm::vec2> nothing(kTiles, glm::vec2(0.0f));
    EXPECT_EQ(scanned("LIST_METHOD_ZBIN", STORAGE_TILE_DEPTHS, gpu::Buffer::of("depths", nothing), kTiles),
              glm::uvec4(ONE_LIGHT_SLICE, 1u, 0u, 0u));
}

TEST_F(ListSteps, everyRunOfNeighbouringSlicesIsOneBoxFromItsNearestToItsFarthest) {
    test::Random random(2);
    std::vector<std::uint64_t> tiles{~std::uint64_t(0), 0x3ull << 62, 0x3ull << 31, 0x5ull << 31,
                                     0xaaaaaaaaaaaaaaaaull};
    for (int i = 0; i < 64; ++i) tiles.push_back(std::uint64_t(1) << i);
    for (int i = 0; i < 500; ++i) {
        std::uint64_t slices = 0; // runs of random length
        bool occupied = false;
        for (int bit = 0; bit < 64; ++bit) {
            occupied ^= random.index(3) == 0;
            slices |= std::uint64_t(occupied) << bit;
        }
        tiles.push_back(slices);
    }
    const std::uint32_t slicing =
        shared::packSlices(std::bit_cast<std::uint32_t>(0x1p-8f + view_.depthKey.x), kShiftOfAnEighth);
    std::vector<glm::uvec4> inputs;
    for (const std::uint64_t slices : tiles)
        inputs.emplace_back(slicing, std::uint32_t(slices), std::uint32_t(slices >> 32), 0u);
    inputs.resize((inputs.size() + 63) / 64 * 64, glm::uvec4(slicing, 0u, 0u, 0u)); // pads to whole groups

    const gpu::Program& program =
        bench_.programs().get({"runs", "", "", "test/list_runs.comp", definesOf("LIST_METHOD_SLICES", 1)});
    const gpu::Buffer view = gpu::Buffer::of("view", std::span(&view_, 1));
    const gpu::Buffer in = gpu::Buffer::of("inputs", inputs);
    const std::size_t boxes = inputs.size() * LIGHT_TILE_SLICES;
    const gpu::Buffer out("outputs", boxes * sizeof(glm::vec2), gpu::BufferUse::Readback);
    gpu::useProgram(program);
    gpu::bindUniformBuffer(UNIFORM_VIEW, view);
    gpu::bindStorageBuffer(1, in);
    gpu::bindStorageBuffer(2, out);
    gpu::dispatch(std::uint32_t(inputs.size() / 64));
    gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
    const std::vector<glm::vec2> runs = out.downloadAs<glm::vec2>(boxes);

    for (std::size_t i = 0; i < tiles.size(); ++i) {
        SCOPED_TRACE(testing::Message() << std::hex << "slices " << tiles[i]);
        const auto occupied = [&](std::uint32_t slice) { return slice < 64 && (tiles[i] >> slice & 1) != 0; };
        std::size_t box = i * LIGHT_TILE_SLICES;
        const std::size_t end = box + LIGHT_TILE_SLICES;
        for (std::uint32_t first = 0; first < 64; ++first) {
            if (!occupied(first) || (first > 0 && occupied(first - 1))) continue;
            std::uint32_t last = first;
            while (occupied(last + 1)) ++last;
            const glm::vec2 depths = shared::depthsOfSlices(slicing, first, last, view_.depthKey.x);
            const auto ahead = [&](float depth) { return shared::aheadMetres(view_.aheadFromDepth, depth); };
            // The same operations, but GLSL lets a division be off by 2.5 units in the last place (4.7.1).
            const glm::vec2 wanted(ahead(depths.y), ahead(depths.x));
            EXPECT_NEAR(runs[box].x, wanted.x, 1e-6f * wanted.x) << "slices " << first << " to " << last;
            EXPECT_NEAR(runs[box].y, wanted.y, 1e-6f * wanted.y) << "slices " << first << " to " << last;
            ++box;
        }
        if (box < end) {
            EXPECT_EQ(runs[box], glm::vec2(-1.0f)) << "a box too many";
        }
    }
}

} // namespace
} // namespace tessera
