#include "renderer/culling/CellBoxes.h"

#include <algorithm>
#include <bit>

namespace tessera::culling {

namespace {

shared::CellBox boxBetween(float nearest, float farthest, const glm::vec4& rays, const FrameConstants& frame,
                           const TileGrid& grid) {
    return shared::cellBox(rays, shared::aheadMetres(frame.view.aheadFromDepth, nearest),
                           shared::aheadMetres(frame.view.aheadFromDepth, farthest), grid.spread);
}

} // namespace

shared::CellBox tileBox(const TileDepths& tile, const glm::vec4& rays, const FrameConstants& frame,
                        const TileGrid& grid) {
    return boxBetween(tile.nearest, tile.farthest, rays, frame, grid);
}

std::span<const shared::CellBox> cellBoxes(Method method, const TileDepths& tile, const glm::vec4& rays,
                                           const FrameConstants& frame, const TileGrid& grid, CellBoxes& memory) {
    if (method == Method::TileMinmax) {
        memory[0] = tileBox(tile, rays, frame, grid);
        return {memory.data(), 1};
    }
    std::size_t count = 0;
    for (std::uint64_t rest = tile.slices; rest != 0;) {
        const auto first = std::uint32_t(std::countr_zero(rest));
        const auto length = method == Method::Cluster ? 1u : std::uint32_t(std::countr_one(rest >> first));
        const std::uint32_t last = first + length - 1;
        const glm::vec2 depths = shared::depthsOfSlices(tile.slicing, first, last, frame.view.depthKey.x);
        memory[count++] =
            boxBetween(std::min(tile.nearest, depths.y), std::max(tile.farthest, depths.x), rays, frame, grid);
        rest &= last == 63 ? 0 : ~std::uint64_t(0) << (last + 1);
    }
    return {memory.data(), count};
}

std::size_t cellsOf(Method method, const TileDepths& tile) {
    return infoOf(method).oneListATile ? 1 : std::size_t(std::popcount(tile.slices));
}

} // namespace tessera::culling
