#pragma once
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

/// A run of depths in a tile, as metres ahead of the origin of lighting space.
struct DepthRun {
    float nearMetres;
    float farMetres;
};

/// All of a tile's depths, or its slices first..last only, not more than the tile's surfaces take up.
DepthRun depthRun(const TileDepths& tile, const FrameConstants& frame);
DepthRun depthRun(const TileDepths& tile, int firstSlice, int lastSlice, const FrameConstants& frame);

} // namespace tessera::culling
