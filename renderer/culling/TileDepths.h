#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "renderer/culling/LightLists.h"

namespace tessera::culling {

/// The depths of the surfaces that one tile shows.
struct TileDepths {
    float nearest = 0.0f;      ///< reverse-Z depth; 0: the tile shows no surface
    float farthest = 0.0f;     ///< reverse-Z depth
    std::uint32_t slicing = 0; ///< packSlices()
    std::uint64_t slices = 0;  ///< bit s: a surface lies in slice s
    bool isEmpty() const { return slices == 0; }
};

/// The depths of a row of tiles, by column.
void findTileDepths(const DepthPicture& picture, const FrameConstants& frame, int row, std::span<TileDepths> tiles);

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
