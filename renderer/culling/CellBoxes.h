#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/TileDepths.h"

namespace tessera::culling {

/// The lists of a row of tiles: of each cell the first entry, counted from the row's first, and how many.
struct RowLists {
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries; ///< numbers of lights
};

/// The box around all that a tile shows. `rays` is TileGrid::rays() of the tile.
shared::CellBox tileBox(const TileDepths& tile, const glm::vec4& rays, const FrameConstants& frame,
                        const TileGrid& grid);

/// The boxes that a method tests lights against, in `memory`, the farthest first: one around each slice that shows a
/// surface (cluster), one around each run of neighbouring ones (tile_2.5d), or one around all (tile_minmax). None is
/// larger than the tile's surfaces need.
using CellBoxes = std::array<shared::CellBox, LIGHT_TILE_SLICES>;
std::span<const shared::CellBox> cellBoxes(Method method, const TileDepths& tile, const glm::vec4& rays,
                                           const FrameConstants& frame, const TileGrid& grid, CellBoxes& memory);

/// How many lists a tile has.
std::size_t cellsOf(Method method, const TileDepths& tile);

} // namespace tessera::culling
