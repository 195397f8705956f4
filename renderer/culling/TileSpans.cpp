#include "renderer/culling/TileSpans.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

namespace tessera::culling {

/// A block of lights, stored as arrays so that tests against a slab vectorise.
class TileSpans::Block {
public:
    static constexpr std::size_t kLights = 64;

    Block(std::span<const shared::CullLight> lights, const glm::vec2& spread) : count_(lights.size()) {
        for (std::size_t i = 0; i < count_; ++i) {
            const glm::vec4& sphere = lights[i].sphere;
            right_[i] = sphere.x;
            up_[i] = sphere.y;
            radius_[i] = sphere.w;
            width_[i] = shared::spreadAt(sphere.z, spread);
        }
    }
    void findColumns(std::span<const glm::vec4> slabs, Range* ranges) { find(right_, slabs, ranges); }
    void findRows(std::span<const glm::vec4> slabs, Range* ranges) { find(up_, slabs, ranges); }

private:
    void find(const float* across, std::span<const glm::vec4> slabs, Range* ranges) {
        const int none = int(slabs.size());
        std::fill_n(first_, count_, none);
        std::fill_n(last_, count_, -1);
        for (int slab = 0; slab < none; ++slab) {
            const glm::vec4 planes = slabs[std::size_t(slab)];
            for (std::size_t i = 0; i < count_; ++i) {
                const bool touches = shared::sphereTouchesSlab(across[i], width_[i], radius_[i], planes);
                const int first = touches ? slab : none, last = touches ? slab : -1;
                first_[i] = first < first_[i] ? first : first_[i];
                last_[i] = last > last_[i] ? last : last_[i];
            }
        }
        for (std::size_t i = 0; i < count_; ++i)
            if (radius_[i] >= 0.0f && last_[i] >= 0) ranges[i] = {std::uint16_t(first_[i]), std::uint16_t(last_[i])};
    }

    std::size_t count_;
    float right_[kLights], up_[kLights], radius_[kLights], width_[kLights];
    int first_[kLights], last_[kLights];
};

void TileSpans::set(std::span<const shared::CullLight> lights, const TileGrid& grid) {
    columnSlabs_.clear();
    rowSlabs_.clear();
    for (std::uint32_t i = 0; i < grid.columns; ++i)
        columnSlabs_.push_back(shared::slabBetween(glm::vec2(grid.rays(i, 0)), grid.spread));
    for (std::uint32_t i = 0; i < grid.rows; ++i) {
        const glm::vec4 rays = grid.rays(0, i);
        rowSlabs_.push_back(shared::slabBetween({rays.z, rays.w}, grid.spread));
    }
    everywhere_.clear();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].sphere.w < 0.0f) everywhere_.push_back(std::uint32_t(i));
    }
    columns_.assign(lights.size(), {});
    rows_.assign(lights.size(), {});
    const std::size_t blocks = (lights.size() + Block::kLights - 1) / Block::kLights;
    tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t i) {
        const std::size_t first = i * Block::kLights;
        Block block(lights.subspan(first, std::min(Block::kLights, lights.size() - first)), grid.spread);
        block.findColumns(columnSlabs_, &columns_[first]);
        block.findRows(rowSlabs_, &rows_[first]);
    });
    sortIntoRows(grid.rows);
}

void TileSpans::sortIntoRows(std::uint32_t rows) {
    // Counting sort: counts per row, prefix sum of row starts, then the fill, which advances each start to the next.
    rowStarts_.assign(rows + 2, 0);
    for (const Range& range : rows_)
        for (std::uint32_t row = range.first; row <= range.last; ++row) ++rowStarts_[row + 2];
    std::partial_sum(rowStarts_.begin(), rowStarts_.end(), rowStarts_.begin());
    rowLights_.resize(rowStarts_.back());
    for (std::size_t i = 0; i < rows_.size(); ++i)
        for (std::uint32_t row = rows_[i].first; row <= rows_[i].last; ++row)
            rowLights_[rowStarts_[row + 1]++] = std::uint32_t(i);
    rowStarts_.pop_back();
}

void TileSpans::ofColumns(std::span<const std::uint32_t> from, std::uint32_t first, std::uint32_t last,
                          std::vector<std::uint32_t>& lights) const {
    // Writes every light and advances only past those kept: the pattern is too irregular for branches.
    lights.resize(from.size());
    std::uint32_t* to = lights.data();
    for (const std::uint32_t light : from) {
        *to = light;
        to += columns_[light].overlaps(first, last) ? 1 : 0;
    }
    lights.resize(std::size_t(to - lights.data()));
}

} // namespace tessera::culling
