#include "renderer/culling/LightLists.h"

#include <algorithm>
#include <array>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/culling/LightReach.h"
#include "renderer/culling/TileDepths.h"
#include "renderer/culling/ZBins.h"

namespace tessera::culling {

namespace {

/// Columns whose lights are gathered together before single tiles are looked at.
constexpr int kBlockColumns = 8;
/// The slicing of a tile with one cell: every depth lies in slice 0.
constexpr std::uint32_t kOneSlice = 31;

/// What one row of tiles contributes; cells and entries count from the row's first until rows are joined.
struct RowLists {
    std::vector<std::uint32_t> rowLights, blockLights, tileLights;
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries;
};

} // namespace

struct LightListBuilder::Scratch {
    LightLists lists;
    LightReach reach;
    std::vector<TileDepths> depths; ///< parallel to LightLists::tiles
    std::vector<RowLists> rows;     ///< layer-major
};

namespace {

struct Build {
    const BuildInput& input;
    TileGrid grid;

    /// Appends the lights of `from` that touch any of `runs` of the tile as one cell.
    void appendCell(const glm::vec4& rays, const std::vector<std::uint32_t>& from, std::span<const DepthRun> runs,
                    RowLists& row) const {
        std::array<shared::CellBox, LIGHT_TILE_SLICES> boxes;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            boxes[i] = shared::cellBox(rays, runs[i].nearMetres, runs[i].farMetres, grid.orthographic);
        }
        const auto first = std::uint32_t(row.entries.size());
        const std::span<const shared::CellBox> used(boxes.data(), runs.size());
        for (const std::uint32_t light : from) {
            const shared::CullLight& cull = input.lights[light];
            const bool touches = std::any_of(used.begin(), used.end(), [&](const shared::CellBox& box) {
                return shared::lightTouchesBox(cull, box);
            });
            if (touches) row.entries.push_back(light);
        }
        row.cells.emplace_back(first, std::uint32_t(row.entries.size()) - first);
    }

    /// The runs of slices that get a test of their own: single slices for clusters, else as long as they are occupied.
    std::size_t occupiedRuns(const TileDepths& depths, std::array<DepthRun, LIGHT_TILE_SLICES>& runs) const {
        std::size_t count = 0;
        for (std::uint64_t rest = depths.slices; rest != 0;) {
            const int first = std::countr_zero(rest);
            const int length = input.method == Method::Cluster ? 1 : std::countr_one(rest >> first);
            runs[count++] = depthRun(depths, first, first + length - 1, input.frame);
            rest &= length == 64 ? 0 : ~(((std::uint64_t(1) << length) - 1) << first);
        }
        return count;
    }

    shared::LightTile tile(const TileDepths& depths, std::uint32_t column, std::uint32_t tileRow, RowLists& row) const {
        const glm::vec4 rays = grid.rays(column, tileRow);
        const DepthRun whole = depthRun(depths, input.frame);
        const auto cell = std::uint32_t(row.cells.size());
        const bool oneCell = input.method != Method::Cluster || std::has_single_bit(depths.slices);
        if (input.method == Method::TileMinmax || std::has_single_bit(depths.slices)) {
            appendCell(rays, row.blockLights, {&whole, 1}, row);
        } else {
            std::array<DepthRun, LIGHT_TILE_SLICES> runs;
            const std::size_t count = occupiedRuns(depths, runs);
            if (oneCell) {
                appendCell(rays, row.blockLights, {runs.data(), count}, row);
            } else {
                // What misses the tile as a whole misses each of its slices.
                const shared::CellBox box = shared::cellBox(rays, whole.nearMetres, whole.farMetres, grid.orthographic);
                row.tileLights.clear();
                std::copy_if(row.blockLights.begin(), row.blockLights.end(), std::back_inserter(row.tileLights),
                             [&](std::uint32_t light) { return shared::lightTouchesBox(input.lights[light], box); });
                for (std::size_t i = 0; i < count; ++i) appendCell(rays, row.tileLights, {&runs[i], 1}, row);
            }
        }
        if (oneCell) return {{cell, kOneSlice, 1u, 0u}};
        return {{cell, depths.slicing, std::uint32_t(depths.slices), std::uint32_t(depths.slices >> 32)}};
    }

    void row(const LightReach& reach, const TileDepths* depths, std::uint32_t tileRow, RowLists& row,
             shared::LightTile* tiles) const {
        row.cells.clear();
        row.entries.clear();
        reach.ofRow(tileRow, row.rowLights);
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            if (column % kBlockColumns == 0)
                reach.ofColumns(row.rowLights, column, std::min(column + kBlockColumns, grid.columns) - 1,
                                row.blockLights);
            if (depths[column].isEmpty()) continue;
            tiles[column] = tile(depths[column], column, tileRow, row);
        }
    }
};

/// Puts the rows' cells and entries behind one another, after the lights that reach everywhere. Cell 0 is empty, for
/// tiles that show nothing.
void joinRows(const Build& build, std::span<const std::uint32_t> everywhere, std::span<RowLists> rows,
              LightLists& lists) {
    std::vector<std::size_t> firstCell{1}, firstEntry{everywhere.size()};
    for (const RowLists& row : rows) {
        firstCell.push_back(firstCell.back() + row.cells.size());
        firstEntry.push_back(firstEntry.back() + row.entries.size());
    }
    lists.cells.resize(firstCell.back());
    lists.entries.resize(firstEntry.back());
    lists.cells[0] = glm::uvec2(0u);
    std::copy(everywhere.begin(), everywhere.end(), lists.entries.begin());
    tbb::parallel_for(std::size_t(0), rows.size(), [&](std::size_t i) {
        const RowLists& row = rows[i];
        std::copy(row.entries.begin(), row.entries.end(), lists.entries.begin() + std::ptrdiff_t(firstEntry[i]));
        for (std::size_t c = 0; c < row.cells.size(); ++c)
            lists.cells[firstCell[i] + c] = row.cells[c] + glm::uvec2(std::uint32_t(firstEntry[i]), 0u);
        for (std::uint32_t column = 0; column < build.grid.columns; ++column) {
            shared::LightTile& tile = lists.tiles[i * build.grid.columns + column];
            if (tile.words.z != 0) tile.words.x += std::uint32_t(firstCell[i]);
        }
    });
}

} // namespace

LightListBuilder::LightListBuilder() : scratch_(std::make_unique<Scratch>()) {}
LightListBuilder::~LightListBuilder() = default;

const LightLists& LightListBuilder::build(const BuildInput& input) {
    const Build build{input, tileGrid(input.frame, input.sizePixels)};
    const std::uint32_t layers = input.transparent ? 2u : 1u;
    const std::size_t tiles = std::size_t(build.grid.columns) * build.grid.rows;
    LightLists& lists = scratch_->lists;
    lists.tiles.assign(tiles * layers, shared::LightTile{{0u, kOneSlice, 0u, 0u}});
    scratch_->depths.resize(tiles * layers);
    scratch_->rows.resize(std::size_t(build.grid.rows) * layers);
    scratch_->reach.set(input.lights, build.grid);

    tbb::parallel_for(std::size_t(0), scratch_->rows.size(), [&](std::size_t i) {
        const DepthPicture& picture = i < build.grid.rows ? input.opaque : *input.transparent;
        const auto tileRow = std::uint32_t(i % build.grid.rows);
        TileDepths* depths = scratch_->depths.data() + i * build.grid.columns;
        for (std::uint32_t column = 0; column < build.grid.columns; ++column) {
            depths[column] = tileDepths(picture, input.frame, input.sizePixels.x, int(column), int(tileRow));
        }
        if (input.method == Method::Zbin) return;
        build.row(scratch_->reach, depths, tileRow, scratch_->rows[i], lists.tiles.data() + i * build.grid.columns);
    });
    if (input.method == Method::Zbin)
        buildZBins(input, scratch_->reach, scratch_->depths, lists);
    else
        joinRows(build, scratch_->reach.everywhere(), scratch_->rows, lists);
    return lists;
}

} // namespace tessera::culling
