#pragma once
#include <span>

#include "renderer/culling/LightLists.h"
#include "renderer/culling/TileDepths.h"
#include "renderer/culling/TileSpans.h"

namespace tessera::culling {

/// Fills lists.tiles, cells and entries by method zbin: splits depth into at most ZBIN_COUNT bins between the frame's
/// nearest and farthest surface, and stores a bitmask of touching lights for every bin and every tile. `depths` is
/// parallel to lists.tiles. Source: Drobot 2017, "Improved Culling for Tiled and Clustered Rendering"; a bin keeps a
/// bitmask instead of an index range, because lights stay in document order, which is unrelated to depth.
void buildZBins(const BuildInput& input, const TileSpans& spans, std::span<const TileDepths> depths, LightLists& lists);

} // namespace tessera::culling
