#include "passes/ScanTiles.h"

#include <algorithm>
#include <bit>

#include "shaders/shared/light_lists.h"

namespace tessera::passes {

glm::uvec4 scanCounts(const gpu::Buffer& tileCounts, std::size_t tiles, const culling::FrameConstants& frame) {
    std::vector<glm::uvec2> counts = tileCounts.downloadAs<glm::uvec2>(tiles);
    std::uint32_t cells = 1; // the empty cell
    std::uint64_t entries = frame.lighting.lights.z;
    for (glm::uvec2& tile : counts) {
        const glm::uvec2 own = tile;
        tile = {cells, std::uint32_t(entries)};
        cells += own.x;
        entries += own.y;
    }
    tileCounts.upload(counts);
    return {cells, std::uint32_t(entries), std::uint32_t(entries >> 32), 0u};
}

glm::uvec4 scanDepths(const gpu::Buffer& tileDepths, std::size_t tiles, const culling::FrameConstants& frame) {
    float nearest = 0.0f, farthest = 2.0f;
    for (const glm::vec2& depths : tileDepths.downloadAs<glm::vec2>(tiles)) {
        if (!(depths.x > 0.0f)) continue;
        nearest = std::max(nearest, depths.x);
        farthest = std::min(farthest, depths.y);
    }
    if (!(nearest > 0.0f)) return {ONE_LIGHT_SLICE, 1u, 0u, 0u};
    const auto low = std::bit_cast<std::uint32_t>(frame.view.depthKey.x + farthest);
    const auto high = std::bit_cast<std::uint32_t>(frame.view.depthKey.x + nearest);
    const std::uint32_t slicing = shared::slicingOf(low, high, frame.lighting.slices.x, ZBIN_COUNT);
    return {slicing, shared::sliceOfKey(high, slicing) + 1u, 0u, 0u};
}

} // namespace tessera::passes
