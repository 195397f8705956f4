#pragma once
#include <span>

#include "renderer/culling/LightLists.h"
#include "renderer/culling/TileDepths.h"
#include "renderer/culling/TileSpans.h"

namespace tessera::culling {

/// Fills in lists.tiles, cells and entries by method zbin: depth is cut into at most ZBIN_COUNT bins between the
/// frame's nearest and farthest surface, every bin and every tile gets a bitmask of the lights that touch it. `depths`
/// is parallel to lists.tiles. Source: Drobot 2017, "Improved Culling for Tiled and Clustered Rendering"; a bin keeps a
/// bitmask instead of a range of indices, because lights stay in document order and a range of those says nothing of
/// depth.
void buildZBins(const BuildInput& input, const TileSpans& spans, std::span<const TileDepths> depths, LightLists& lists);

} // namespace tessera::culling
