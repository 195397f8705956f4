#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/culling/TileGrid.h"
#include "shaders/shared/culling.h"

namespace tessera::culling {

/// Which rows and columns of tiles each light may touch, by the planes between them. The planes of a tile are those of
/// its row and column, so each is looked at once a light and not once a tile.
class TileSpans {
public:
    void set(std::span<const shared::CullLight> lights, const TileGrid& grid);

    /// Lights that reach everywhere, ascending.
    std::span<const std::uint32_t> everywhere() const { return everywhere_; }
    /// The others that touch a row, ascending.
    void ofRow(std::uint32_t row, std::vector<std::uint32_t>& lights) const;
    /// Those of `from` that touch any of the columns first..last.
    void ofColumns(const std::vector<std::uint32_t>& from, std::uint32_t first, std::uint32_t last,
                   std::vector<std::uint32_t>& lights) const;

private:
    struct Range {
        std::uint16_t first = 1, last = 0; ///< first > last: none
        bool overlaps(std::uint32_t from, std::uint32_t to) const { return (first <= to) & (last >= from); }
    };
    static Range rangeOf(float across, const shared::CullLight& light, std::span<const glm::vec2> slabs,
                         const glm::vec2& spread);

    std::vector<std::uint32_t> everywhere_;
    std::vector<Range> columns_, rows_; ///< by light
    std::vector<glm::vec2> columnSlabs_, rowSlabs_;
};

} // namespace tessera::culling
