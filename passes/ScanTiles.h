#pragma once
#include "renderer/culling/TileGrid.h"
#include "renderer/gpu/Buffer.h"

/// The scan of shaders/lib/lists/list_scan.glsl on the CPU, for light lists built in fragment shaders: there, a single
/// invocation would have to loop over all tiles. Both functions return the totals as that shader writes them.
namespace tessera::passes {

/// Turns cells and entries of each tile (uvec2) into the index of its first of each.
glm::uvec4 scanCounts(const gpu::Buffer& tileCounts, std::size_t tiles, const culling::FrameConstants& frame);

/// The bins of depth between the nearest and farthest surface of all tiles (vec2 each).
glm::uvec4 scanDepths(const gpu::Buffer& tileDepths, std::size_t tiles, const culling::FrameConstants& frame);

} // namespace tessera::passes
