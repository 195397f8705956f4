#include "renderer/culling/TileSpans.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tessera::culling {

TileSpans::Range TileSpans::rangeOf(float across, const shared::CullLight& light, std::span<const glm::vec2> slabs,
                                    const glm::vec2& spread) {
    Range range;
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        if (!shared::sphereTouchesSlab(across, light.sphere.z, light.sphere.w, slabs[i], spread)) continue;
        if (range.first > range.last) range.first = std::uint16_t(i);
        range.last = std::uint16_t(i);
    }
    return range;
}

void TileSpans::set(std::span<const shared::CullLight> lights, const TileGrid& grid) {
    columnSlabs_.clear();
    rowSlabs_.clear();
    for (std::uint32_t i = 0; i < grid.columns; ++i) columnSlabs_.emplace_back(glm::vec2(grid.rays(i, 0)));
    for (std::uint32_t i = 0; i < grid.rows; ++i) {
        const glm::vec4 rays = grid.rays(0, i);
        rowSlabs_.emplace_back(rays.z, rays.w);
    }
    everywhere_.clear();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].sphere.w < 0.0f) everywhere_.push_back(std::uint32_t(i));
    }
    columns_.assign(lights.size(), {});
    rows_.assign(lights.size(), {});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lights.size(), 64), [&](const auto& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            if (lights[i].sphere.w < 0.0f) continue;
            columns_[i] = rangeOf(lights[i].sphere.x, lights[i], columnSlabs_, grid.spread);
            rows_[i] = rangeOf(lights[i].sphere.y, lights[i], rowSlabs_, grid.spread);
        }
    });
}

void TileSpans::ofRow(std::uint32_t row, std::vector<std::uint32_t>& lights) const {
    lights.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (rows_[i].overlaps(row, row)) lights.push_back(std::uint32_t(i));
    }
}

void TileSpans::ofColumns(const std::vector<std::uint32_t>& from, std::uint32_t first, std::uint32_t last,
                          std::vector<std::uint32_t>& lights) const {
    // Every light is written, and kept by moving on: which ones stay is too irregular for branches.
    lights.resize(from.size());
    std::uint32_t* to = lights.data();
    for (const std::uint32_t light : from) {
        *to = light;
        to += columns_[light].overlaps(first, last) ? 1 : 0;
    }
    lights.resize(std::size_t(to - lights.data()));
}

} // namespace tessera::culling
