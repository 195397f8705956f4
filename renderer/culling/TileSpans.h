#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/TileGrid.h"
#include "shaders/shared/culling.h"

namespace tessera::culling {

/// The rows and columns of tiles that each light may touch, found by the planes between them. A tile's planes are those
/// of its row and column, so each plane is tested once per light instead of once per tile.
class TileSpans {
public:
    void set(std::span<const shared::CullLight> lights, const TileGrid& grid);

    /// Unbounded lights, ascending.
    std::span<const std::uint32_t> everywhere() const { return everywhere_; }
    /// Bounded lights that touch a row, ascending.
    std::span<const std::uint32_t> ofRow(std::uint32_t row) const {
        return std::span(rowLights_).subspan(rowStarts_[row], rowStarts_[row + 1] - rowStarts_[row]);
    }
    /// Selects the lights of `from` that touch any of the columns first..last.
    void ofColumns(std::span<const std::uint32_t> from, std::uint32_t first, std::uint32_t last,
                   std::vector<std::uint32_t>& lights) const;

private:
    struct Range {
        std::uint16_t first = 1, last = 0; ///< first > last: none
        bool overlaps(std::uint32_t from, std::uint32_t to) const { return (first <= to) & (last >= from); }
    };
    class Block;
    void sortIntoRows(std::uint32_t rows);

    std::vector<std::uint32_t> everywhere_;
    std::vector<Range> columns_, rows_; ///< by light
    std::vector<glm::vec4> columnSlabs_, rowSlabs_;
    std::vector<std::uint32_t> rowLights_; ///< lights of all rows, concatenated
    std::vector<std::size_t> rowStarts_;   ///< by row, and the end of the last
};

} // namespace tessera::culling
