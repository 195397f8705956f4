#include "validation/culling/VisitedLights.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "validation/figures/Percentile.h"

namespace tessera::validation {
namespace {

using culling::Method;

/// Index of a depth's slice; `slicing` is the tile's second word.
std::uint32_t sliceAt(const engine::DrawnLists& drawn, float depth, std::uint32_t slicing) {
    const std::uint32_t key = std::bit_cast<std::uint32_t>(drawn.view.depthKey.x + depth);
    const std::uint32_t shift = slicing % 32;
    return (key - (slicing - shift)) >> shift;
}

} // namespace

VisitedLights::VisitedLights(const engine::DrawnLists& drawn) : drawn_(drawn) {}

VisitedCell VisitedLights::cellAt(int column, int row, float depth, SurfaceLayer layer) const {
    if (drawn_.culling.method == Method::None) return {};
    const glm::uvec4& grid = drawn_.lighting.tileGrid;
    const std::uint32_t side = 1u << grid.w;
    const std::uint32_t tileColumn = std::uint32_t(column) / side;
    const std::uint32_t tileRow = (grid.z - 1u - std::uint32_t(row)) / side;
    std::uint32_t tile = tileRow * grid.x + tileColumn;
    if (layer == SurfaceLayer::Transparent) tile += grid.x * grid.y;
    return {tile, sliceAt(drawn_, depth, drawn_.lists.tiles.at(tile).words.y)};
}

void VisitedLights::at(const VisitedCell& cell, std::vector<int>& sceneLights) const {
    sceneLights.clear();
    if (drawn_.culling.method == Method::None)
        sceneLights = drawn_.sceneIndex;
    else if (drawn_.culling.method == Method::Zbin)
        ofMasks(cell, sceneLights);
    else
        ofList(cell, sceneLights);
    // Lights that cast shadows are visited first (frame::packLights).
    std::ranges::sort(sceneLights);
}

void VisitedLights::ofList(const VisitedCell& visited, std::vector<int>& sceneLights) const {
    const glm::uvec4& tile = drawn_.lists.tiles.at(visited.tile).words;
    const std::uint64_t occupied = std::uint64_t(tile.w) << 32 | tile.z;
    const std::uint64_t nearer = visited.slice >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << visited.slice) - 1;
    const glm::uvec2 cell = drawn_.lists.cells.at(tile.x + std::uint32_t(std::popcount(occupied & nearer)));
    const auto sceneLight = [&](std::uint32_t light) { return drawn_.sceneIndex.at(light); };
    std::vector<std::uint32_t> lights;
    for (std::uint32_t i = 0; i < cell.y; ++i) lights.push_back(drawn_.lists.entries.at(cell.x + i));
    const auto own = std::ptrdiff_t(lights.size());
    for (std::size_t i = 0; i < drawn_.everywhere.size(); ++i) lights.push_back(drawn_.lists.entries.at(i));
    std::inplace_merge(lights.begin(), lights.begin() + own, lights.end());
    std::transform(lights.begin(), lights.end(), std::back_inserter(sceneLights), sceneLight);
}

void VisitedLights::ofMasks(const VisitedCell& visited, std::vector<int>& sceneLights) const {
    const glm::uvec4& tile = drawn_.lists.tiles.at(visited.tile).words;
    const glm::uvec2 words = drawn_.lists.cells.at(visited.slice);
    const std::uint32_t maskWords = drawn_.lighting.lights.w;
    for (std::uint32_t word = words.x; word < words.y; ++word) {
        std::uint32_t bits =
            drawn_.lists.entries.at(tile.x + word) & drawn_.lists.entries.at(visited.slice * maskWords + word);
        for (; bits != 0; bits &= bits - 1)
            sceneLights.push_back(drawn_.sceneIndex.at(word * 32 + std::uint32_t(std::countr_zero(bits))));
    }
}

CellFigures CellLights::figures() const {
    std::vector<Cell> once = cells_;
    std::ranges::sort(once);
    once.erase(std::unique(once.begin(), once.end()), once.end());
    if (once.empty()) return {};
    std::vector<double> lights;
    for (const Cell& cell : once) lights.push_back(double(cell.lights));
    CellFigures figures;
    figures.count = lights.size();
    figures.mean = std::accumulate(lights.begin(), lights.end(), 0.0) / double(lights.size());
    figures.max = std::uint64_t(std::ranges::max(lights));
    figures.p99 = std::uint64_t(nearestRank(lights, 990));
    return figures;
}

} // namespace tessera::validation
