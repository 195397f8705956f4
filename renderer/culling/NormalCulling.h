#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/CellBoxes.h"

namespace tessera::culling {

/// Whether the lists of all cells together have so many entries that looking at normals pays, or is asked for.
bool isLongEnough(NormalTest test, std::size_t entries, std::size_t cells);

/// Takes lights from the lists of cells of which they stand behind all surfaces, and so change none.
class NormalCulling {
public:
    /// Of lists that isLongEnough(). All of the arguments must outlive it.
    NormalCulling(const BuildInput& input, const TileGrid& grid, const NormalPicture& normals);

    /// Of a row of tiles, whose depths are given by column. Rows may be culled at the same time.
    void cull(std::uint32_t tileRow, std::span<const TileDepths> tiles, RowLists& lists) const;

private:
    const BuildInput& input_;
    const TileGrid& grid_;
    const NormalPicture& normals_;
    std::vector<glm::vec4> lights_; ///< position in culling space, and how far from it the light may shine from
};

} // namespace tessera::culling
