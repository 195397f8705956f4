#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/CellBoxes.h"

namespace tessera::culling {

/// Whether to cull by normals: always with On, with WhereWorth from kLightsWorthNormals entries per cell on.
bool isLongEnough(NormalTest test, std::size_t entries, std::size_t cells);

/// Removes lights from cells whose surfaces all face away from them, which does not change any pixel.
class NormalCulling {
public:
    /// Requires isLongEnough() of the lists. All arguments must outlive the object.
    NormalCulling(const BuildInput& input, const TileGrid& grid, const NormalPicture& normals);

    /// Culls the lists of a row of tiles; `tiles` holds the depths by column. Rows may be culled concurrently.
    void cull(std::uint32_t tileRow, std::span<const TileDepths> tiles, RowLists& lists) const;

private:
    const BuildInput& input_;
    const TileGrid& grid_;
    const NormalPicture& normals_;
    std::vector<glm::vec4> lights_; ///< xyz position in culling space, w error bound
};

} // namespace tessera::culling
