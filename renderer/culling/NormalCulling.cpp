#include "renderer/culling/NormalCulling.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "renderer/culling/TileNormals.h"

namespace tessera::culling {

namespace {

constexpr float kLongestNormal = 1.7320509f; ///< half diagonal of the cube [-1, 1]^3, rounded up

/// Position of a bounded light; w: error bound scaled by the longest normal. The bound covers the extent of an area
/// light, the rounding of the light's position and of surfaces in its range, and for cones the offset of the apex
/// (CullLights.cpp). Light and range lie within three radii of the bounding sphere's centre, except the surface of an
/// area light.
glm::vec4 positionAndError(const shared::CullLight& light, const glm::vec4& depthKey) {
    const float surfaceMetres = shared::hasCone(light) ? 0.0f : light.apex.w;
    const float farthestMetres = 3.0f * light.sphere.w + glm::length(glm::vec3(light.sphere)) + surfaceMetres;
    float error = shared::roundingMargin(farthestMetres, depthKey);
    if (!shared::hasCone(light)) return {glm::vec3(light.sphere), kLongestNormal * (surfaceMetres + error)};
    if (light.apex.w > 0.0f) error += shared::roundingMargin(0.0f, depthKey) / light.apex.w;
    return {glm::vec3(light.apex), kLongestNormal * error};
}

/// Half-spaces in front of a cell's surfaces. With m the cell's centre, h its half size and p a surface point, normal n
/// faces a light at l if n.(l - p) = n.(l - m) - n.(p - m) > 0, and |n.(p - m)| is at most |n|.h.
class Front {
public:
    Front(const shared::CellBox& box, const NormalBounds& normals)
        : normals_(normals), middle_(0.5f * (glm::vec3(box.low) + glm::vec3(box.high))) {
        const glm::vec3 halfSize = 0.5f * (glm::vec3(box.high) - glm::vec3(box.low));
        const glm::vec3 farthest = glm::max(glm::abs(glm::vec3(box.low)), glm::abs(glm::vec3(box.high)));
        const glm::vec3 longest = glm::max(glm::abs(normals.low), glm::abs(normals.high));
        // The second term covers rounding: 1e-7 of each coordinate, several times.
        extent_ = glm::dot(longest, halfSize) + 4e-6f * (farthest.x + farthest.y + farthest.z);
    }

    /// `light` is positionAndError().
    bool mayBeLitFrom(const glm::vec4& light) const {
        return mostAlong(light.x - middle_.x, light.y - middle_.y, light.z - middle_.z) >= -(extent_ + light.w);
    }

private:
    /// Largest dot product of a bounded normal with a vector. Per component, so that loops over lights vectorise.
    float mostAlong(float x, float y, float z) const {
        const float alongX = std::max(normals_.low.x * x, normals_.high.x * x);
        const float alongY = std::max(normals_.low.y * y, normals_.high.y * y);
        const float alongZ = std::max(normals_.low.z * z, normals_.high.z * z);
        return alongX + alongY + alongZ;
    }

    NormalBounds normals_;
    glm::vec3 middle_;
    float extent_; ///< half extent of the cell along its normals
};

PixelRect pixelsOf(const TileGrid& grid, std::uint32_t column, std::uint32_t row) {
    const std::size_t side = grid.sidePixels, width = grid.sizePixels.x, height = grid.sizePixels.y;
    const std::size_t left = column * side, below = std::min(height, (row + 1) * side);
    return {left, std::min(width, left + side), height - below, height - row * side};
}

/// Compacts `run` to the lights in front of any of `fronts`, stored from entries[kept] on.
void keepInFront(const glm::uvec2& run, std::span<const Front> fronts, std::span<const glm::vec4> lights,
                 std::size_t& kept, std::vector<std::uint32_t>& entries) {
    const auto keep = [&](const auto& isInFront) {
        for (std::uint32_t entry = run.x; entry < run.x + run.y; ++entry) {
            const std::uint32_t light = entries[entry];
            entries[kept] = light;
            kept += isInFront(lights[light]) ? 1 : 0;
        }
    };
    if (fronts.size() == 1)
        keep([front = fronts[0]](const glm::vec4& light) { return front.mayBeLitFrom(light); });
    else
        keep([&](const glm::vec4& light) {
            return std::ranges::any_of(fronts, [&](const Front& front) { return front.mayBeLitFrom(light); });
        });
}

} // namespace

bool isLongEnough(NormalTest test, std::size_t entries, std::size_t cells) {
    if (test == NormalTest::Off || entries == 0) return false;
    return test == NormalTest::On || entries >= std::size_t(kLightsWorthNormals) * cells;
}

NormalCulling::NormalCulling(const BuildInput& input, const TileGrid& grid, const NormalPicture& normals)
    : input_(input), grid_(grid), normals_(normals) {
    assert(!input.opaque.isRange);
    lights_.reserve(input.lights.size());
    for (const shared::CullLight& light : input.lights)
        lights_.push_back(positionAndError(light, input.frame.view.depthKey));
}

void NormalCulling::cull(std::uint32_t tileRow, std::span<const TileDepths> tiles, RowLists& lists) const {
    const SurfacePictures pictures{input_.opaque.depth, normals_, grid_.sizePixels.x};
    CellBoxes memory;
    std::vector<NormalBounds> normals;
    std::vector<Front> fronts;
    const auto findFronts = [&](std::uint32_t column, bool bySlice) {
        const PixelRect pixels = pixelsOf(grid_, column, tileRow);
        if (bySlice)
            findNormalsBySlice(pictures, pixels, tiles[column], input_.frame.view.depthKey.x, normals);
        else
            findNormals(pictures, pixels, normals);
        const std::span<const shared::CellBox> boxes =
            cellBoxes(input_.method, tiles[column], grid_.rays(column, tileRow), input_.frame, grid_, memory);
        fronts.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i) fronts.emplace_back(boxes[i], normals[bySlice ? i : 0]);
    };
    std::size_t kept = 0, cell = 0;
    for (std::uint32_t column = 0; column < tiles.size(); ++column) {
        if (tiles[column].isEmpty()) continue;
        const std::span<glm::uvec2> cells(lists.cells.data() + cell, cellsOf(input_.method, tiles[column]));
        cell += cells.size();
        const std::size_t entries = cells.back().x + cells.back().y - cells.front().x;
        const bool isCulled = isLongEnough(input_.normalTest, entries, cells.size());
        if (isCulled) findFronts(column, cells.size() > 1);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::uvec2 run = std::exchange(cells[i], glm::uvec2(std::uint32_t(kept), 0u));
            if (isCulled) {
                const std::span<const Front> ofCell = cells.size() > 1 ? std::span(fronts).subspan(i, 1) : fronts;
                keepInFront(run, ofCell, lights_, kept, lists.entries);
            } else {
                const auto first = lists.entries.begin() + run.x;
                if (kept != run.x) std::copy(first, first + run.y, lists.entries.begin() + std::ptrdiff_t(kept));
                kept += run.y;
            }
            cells[i].y = std::uint32_t(kept) - cells[i].x;
        }
    }
    lists.entries.resize(kept);
}

} // namespace tessera::culling
