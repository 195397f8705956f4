#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/TileDepths.h"

namespace tessera::culling {

/// Light lists of a row of tiles. A cell holds its first entry, relative to the row's first, and its number of entries.
struct RowLists {
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries; ///< light indices
};

/// Bounds all visible surfaces of a tile. `rays` is TileGrid::rays() of the tile.
shared::CellBox tileBox(const TileDepths& tile, const glm::vec4& rays, const FrameConstants& frame,
                        const TileGrid& grid);

/// Boxes that a method tests lights against, stored in `memory`, farthest first: one per occupied slice (cluster), one
/// per run of adjacent occupied slices (tile_2.5d), or one per tile (tile_minmax). All are clamped to the tile's
/// nearest and farthest surface.
using CellBoxes = std::array<shared::CellBox, LIGHT_TILE_SLICES>;
std::span<const shared::CellBox> cellBoxes(Method method, const TileDepths& tile, const glm::vec4& rays,
                                           const FrameConstants& frame, const TileGrid& grid, CellBoxes& memory);

/// Number of light lists of a tile.
std::size_t cellsOf(Method method, const TileDepths& tile);

} // namespace tessera::culling
