#pragma once
#include <cstdint>
#include <span>

#include "renderer/culling/LightLists.h"

namespace tessera::culling {

/// Depth range and occupied slices of a tile's visible surfaces.
struct TileDepths {
    float nearest = 0.0f;      ///< reverse-Z depth; 0: the tile shows no surface
    float farthest = 0.0f;     ///< reverse-Z depth
    std::uint32_t slicing = 0; ///< packSlices()
    std::uint64_t slices = 0;  ///< bit s: a surface lies in slice s
    bool isEmpty() const { return slices == 0; }
};

/// Finds the depths of a row of tiles, by column.
void findTileDepths(const DepthPicture& picture, const FrameConstants& frame, int row, std::span<TileDepths> tiles);

} // namespace tessera::culling
