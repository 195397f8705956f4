#include "renderer/culling/ZBins.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

namespace tessera::culling {

namespace {

constexpr std::size_t kBits = 32;

struct Bins {
    std::uint32_t slicing = 0;
    std::uint32_t count = 0;
};

/// Bins over the depths of the frame's surfaces, as fine as ZBIN_COUNT allows.
Bins binsOf(std::span<const TileDepths> depths, const FrameConstants& frame) {
    float nearest = 0.0f, farthest = 2.0f;
    for (const TileDepths& tile : depths) {
        if (tile.isEmpty()) continue;
        nearest = std::max(nearest, tile.nearest);
        farthest = std::min(farthest, tile.farthest);
    }
    if (!(nearest > 0.0f)) return {ONE_LIGHT_SLICE, 1};
    const std::uint32_t low = std::bit_cast<std::uint32_t>(frame.view.depthKey.x + farthest);
    const std::uint32_t high = std::bit_cast<std::uint32_t>(frame.view.depthKey.x + nearest);
    const std::uint32_t slicing = shared::slicingOf(low, high, frame.lighting.slices.x, ZBIN_COUNT);
    return {slicing, shared::sliceOfKey(high, slicing) + 1};
}

void setBit(std::uint32_t* mask, std::size_t bit) {
    mask[bit / kBits] |= 1u << (bit % kBits);
}

struct DepthRun {
    float nearMetres, farMetres; ///< ahead of the origin of lighting space
};

/// Depth range of bin `index`.
DepthRun binDepths(const Bins& bins, std::uint32_t index, const FrameConstants& frame) {
    const glm::vec2 depths = shared::depthsOfSlices(bins.slicing, index, index, frame.view.depthKey.x);
    return {shared::aheadMetres(frame.view.aheadFromDepth, depths.y),
            shared::aheadMetres(frame.view.aheadFromDepth, std::max(0.0f, depths.x))};
}

} // namespace

void buildZBins(const BuildInput& input, const TileSpans& spans, std::span<const TileDepths> depths,
                LightLists& lists) {
    const TileGrid grid = tileGrid(input.frame);
    const Bins bins = binsOf(depths, input.frame);
    const std::size_t words = (input.lights.size() + kBits - 1) / kBits;
    const std::size_t tiles = std::size_t(grid.columns) * grid.rows;
    // The masks of tiles do not depend on depth, so both layers share them.
    lists.entries.assign((bins.count + tiles) * words, 0u);
    lists.cells.assign(bins.count, glm::uvec2(0u));

    tbb::parallel_for(0u, bins.count, [&](std::uint32_t bin) {
        std::uint32_t* mask = lists.entries.data() + bin * words;
        const DepthRun run = binDepths(bins, bin, input.frame);
        for (std::size_t i = 0; i < input.lights.size(); ++i) {
            const glm::vec4& sphere = input.lights[i].sphere;
            const bool everywhere = sphere.w < 0.0f;
            if (everywhere || shared::sphereTouchesDepths(sphere, run.nearMetres, run.farMetres)) setBit(mask, i);
        }
        const std::uint32_t* const end = mask + words;
        const auto occupied = [](std::uint32_t word) { return word != 0; };
        const std::uint32_t* first = std::find_if(static_cast<const std::uint32_t*>(mask), end, occupied);
        const std::uint32_t* last = end;
        while (last != first && !occupied(last[-1])) --last;
        lists.cells[bin] = glm::uvec2(std::uint32_t(first - mask), std::uint32_t(last - mask));
    });
    tbb::parallel_for(0u, grid.rows, [&](std::uint32_t row) {
        std::vector<std::uint32_t> tileLights;
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            const std::size_t tile = std::size_t(row) * grid.columns + column;
            const std::size_t first = (bins.count + tile) * words;
            for (std::size_t at = tile; at < lists.tiles.size(); at += tiles)
                lists.tiles[at].words = glm::uvec4(std::uint32_t(first), bins.slicing, 1u, 0u);
            std::uint32_t* mask = lists.entries.data() + first;
            for (const std::uint32_t light : spans.everywhere()) setBit(mask, light);
            spans.ofColumns(spans.ofRow(row), column, column, tileLights);
            for (const std::uint32_t light : tileLights) setBit(mask, light);
        }
    });
}

} // namespace tessera::culling
