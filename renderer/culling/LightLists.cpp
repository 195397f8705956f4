#include "renderer/culling/LightLists.h"

#include <algorithm>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "renderer/culling/Candidates.h"
#include "renderer/culling/NormalCulling.h"
#include "renderer/culling/TileDepths.h"
#include "renderer/culling/TileSpans.h"
#include "renderer/culling/ZBins.h"

namespace tessera::culling {

namespace {

/// Light lists of a row of tiles, with scratch memory.
struct Row {
    std::vector<std::uint32_t> blockLights;
    Candidates block, tile;
    RowLists lists;
};

} // namespace

struct LightListBuilder::Scratch {
    LightLists lists;
    TileSpans spans;
    std::vector<TileDepths> depths; ///< parallel to LightLists::tiles
    std::vector<Row> rows;          ///< layer-major
};

namespace {

struct Build {
    const BuildInput& input;
    TileGrid grid;

    static void appendCell(Candidates& candidates, std::span<const shared::CellBox> boxes, RowLists& lists) {
        const auto first = std::uint32_t(lists.entries.size());
        candidates.mark(boxes);
        candidates.appendMarked(lists.entries);
        lists.cells.emplace_back(first, std::uint32_t(lists.entries.size()) - first);
    }

    /// Appends the tile's cells; row.block holds the candidate lights.
    shared::LightTile tile(const TileDepths& depths, const glm::vec4& rays, Row& row) const {
        const auto cell = std::uint32_t(row.lists.cells.size());
        CellBoxes memory;
        const std::span<const shared::CellBox> boxes = cellBoxes(input.method, depths, rays, input.frame, grid, memory);
        if (infoOf(input.method).oneListATile || boxes.size() == 1) {
            appendCell(row.block, boxes, row.lists);
            return {{cell, ONE_LIGHT_SLICE, 1u, 0u}};
        }
        // Lights that miss the whole tile miss each of its slices.
        const shared::CellBox whole = tileBox(depths, rays, input.frame, grid);
        row.block.mark({&whole, 1});
        row.block.copyMarkedTo(row.tile);
        for (const shared::CellBox& box : boxes) appendCell(row.tile, {&box, 1}, row.lists);
        return {{cell, depths.slicing, std::uint32_t(depths.slices), std::uint32_t(depths.slices >> 32)}};
    }

    void row(const TileSpans& spans, const TileDepths* depths, std::uint32_t tileRow, Row& row,
             shared::LightTile* tiles) const {
        row.lists.cells.clear();
        row.lists.entries.clear();
        const std::span<const std::uint32_t> rowLights = spans.ofRow(tileRow);
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            if (column % CULL_BLOCK_COLUMNS == 0) {
                const std::uint32_t last = std::min(column + CULL_BLOCK_COLUMNS, grid.columns) - 1;
                spans.ofColumns(rowLights, column, last, row.blockLights);
                row.block.assign(row.blockLights, input.lights);
            }
            if (!depths[column].isEmpty()) tiles[column] = tile(depths[column], grid.rays(column, tileRow), row);
        }
    }
};

/// Concatenates the rows' cells and entries, after the entries of unbounded lights. Cell 0 is empty, for tiles without
/// surfaces.
void joinRows(const Build& build, std::span<const std::uint32_t> everywhere, std::span<const Row> rows,
              LightLists& lists) {
    std::vector<std::size_t> firstCell{1}, firstEntry{everywhere.size()};
    for (const Row& row : rows) {
        firstCell.push_back(firstCell.back() + row.lists.cells.size());
        firstEntry.push_back(firstEntry.back() + row.lists.entries.size());
    }
    lists.cells.resize(firstCell.back());
    lists.entries.resize(firstEntry.back());
    lists.cells[0] = glm::uvec2(0u);
    std::copy(everywhere.begin(), everywhere.end(), lists.entries.begin());
    tbb::parallel_for(std::size_t(0), rows.size(), [&](std::size_t i) {
        const RowLists& row = rows[i].lists;
        std::copy(row.entries.begin(), row.entries.end(), lists.entries.begin() + std::ptrdiff_t(firstEntry[i]));
        for (std::size_t c = 0; c < row.cells.size(); ++c)
            lists.cells[firstCell[i] + c] = row.cells[c] + glm::uvec2(std::uint32_t(firstEntry[i]), 0u);
        for (std::uint32_t column = 0; column < build.grid.columns; ++column) {
            shared::LightTile& tile = lists.tiles[i * build.grid.columns + column];
            if (tile.words.z == 0) continue; // no surface
            tile.words.x += std::uint32_t(firstCell[i]);
            if (!infoOf(build.input.method).oneListATile) continue;
            const glm::uvec2& run = lists.cells[tile.words.x];
            tile.words = {tile.words.x, tile.words.y, run.x, run.y};
        }
    });
}

} // namespace

LightListBuilder::LightListBuilder() : scratch_(std::make_unique<Scratch>()) {}
LightListBuilder::~LightListBuilder() = default;

const LightLists& LightListBuilder::build(const BuildInput& input) {
    const Build build{input, tileGrid(input.frame)};
    const std::uint32_t layers = input.transparent ? 2u : 1u;
    const std::size_t tiles = std::size_t(build.grid.columns) * build.grid.rows;
    LightLists& lists = scratch_->lists;
    lists.tiles.assign(tiles * layers, shared::LightTile{{0u, ONE_LIGHT_SLICE, 0u, 0u}});
    scratch_->depths.resize(tiles * layers);
    scratch_->rows.resize(std::size_t(build.grid.rows) * layers);
    scratch_->spans.set(input.lights, build.grid);

    tbb::parallel_for(std::size_t(0), scratch_->rows.size(), [&](std::size_t i) {
        const DepthPicture& picture = i < build.grid.rows ? input.opaque : *input.transparent;
        const auto tileRow = std::uint32_t(i % build.grid.rows);
        TileDepths* depths = scratch_->depths.data() + i * build.grid.columns;
        findTileDepths(picture, input.frame, int(tileRow), {depths, build.grid.columns});
        if (input.method == Method::Zbin) return;
        build.row(scratch_->spans, depths, tileRow, scratch_->rows[i], lists.tiles.data() + i * build.grid.columns);
    });
    if (input.method == Method::Zbin) {
        buildZBins(input, scratch_->spans, scratch_->depths, lists);
        return lists;
    }
    std::size_t entries = 0, cells = 0;
    for (std::uint32_t row = 0; row < build.grid.rows; ++row) {
        entries += scratch_->rows[row].lists.entries.size();
        cells += scratch_->rows[row].lists.cells.size();
    }
    if (isLongEnough(input.normalTest, entries, cells)) {
        const NormalPicture normals = input.readNormals();
        const NormalCulling culling(input, build.grid, normals);
        tbb::parallel_for(0u, build.grid.rows, [&](std::uint32_t row) {
            culling.cull(row, {scratch_->depths.data() + std::size_t(row) * build.grid.columns, build.grid.columns},
                         scratch_->rows[row].lists);
        });
    }
    joinRows(build, scratch_->spans.everywhere(), scratch_->rows, lists);
    return lists;
}

} // namespace tessera::culling
