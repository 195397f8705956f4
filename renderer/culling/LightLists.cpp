#include "renderer/culling/LightLists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/culling/Candidates.h"
#include "renderer/culling/TileDepths.h"
#include "renderer/culling/TileNormals.h"
#include "renderer/culling/TileSpans.h"
#include "renderer/culling/ZBins.h"

namespace tessera::culling {

namespace {

/// Shorter lists cost less to visit than the normals of their cells to decode.
constexpr std::size_t kLightsWorthNormals = 12;

/// The part of a cell that lights must lie in front of to change it.
struct Front {
    shared::NormalBox normals;
    glm::vec3 middle;
    float reach; ///< shared::normalReach()

    Front(const shared::CellBox& ofBox, const shared::NormalBox& ofNormals)
        : normals(ofNormals), middle(0.5f * (glm::vec3(ofBox.low) + glm::vec3(ofBox.high))),
          reach(shared::normalReach(ofBox, ofNormals)) {}
    /// `place` is shared::placeOfLight().
    bool sees(const glm::vec4& place) const {
        return shared::mostAlong(place.x - middle.x, place.y - middle.y, place.z - middle.z, normals) >=
               -(reach + place.w);
    }
};

/// What one row of tiles contributes; cells and entries count from the row's first until rows are joined.
struct RowLists {
    std::vector<std::uint32_t> blockLights;
    Candidates block, tile;
    std::vector<shared::NormalBox> normals; ///< of a tile's cells
    std::vector<Front> fronts;              ///< of a tile's cells, in their order, or of its only one
    std::vector<glm::uvec2> cells;
    std::vector<std::uint32_t> entries;
};

} // namespace

struct LightListBuilder::Scratch {
    LightLists lists;
    TileSpans spans;
    std::vector<glm::vec4> places;  ///< shared::placeOfLight() of each, where normals are looked at
    std::vector<TileDepths> depths; ///< parallel to LightLists::tiles
    std::vector<RowLists> rows;     ///< layer-major
};

namespace {

using Boxes = std::array<shared::CellBox, LIGHT_TILE_SLICES>;

struct Build {
    const BuildInput& input;
    TileGrid grid;
    std::span<const glm::vec4> places; ///< of the lights, where normals may be looked at

    shared::CellBox box(const glm::vec4& rays, const DepthRun& run) const {
        return shared::cellBox(rays, run.nearMetres, run.farMetres, grid.spread);
    }

    /// Boxes around a tile's occupied slices: one per slice for clusters, else one per run of neighbours.
    std::size_t occupiedBoxes(const glm::vec4& rays, const TileDepths& depths, Boxes& boxes) const {
        std::size_t count = 0;
        for (std::uint64_t rest = depths.slices; rest != 0;) {
            const int first = std::countr_zero(rest);
            const int length = input.method == Method::Cluster ? 1 : std::countr_one(rest >> first);
            boxes[count++] = box(rays, depthRun(depths, first, first + length - 1, input.frame));
            rest &= length == 64 ? 0 : ~(((std::uint64_t(1) << length) - 1) << first);
        }
        return count;
    }

    static void appendCell(Candidates& candidates, std::span<const shared::CellBox> boxes, RowLists& row) {
        const auto first = std::uint32_t(row.entries.size());
        candidates.mark(boxes);
        candidates.appendMarked(row.entries);
        row.cells.emplace_back(first, std::uint32_t(row.entries.size()) - first);
    }

    /// Appends the tile's cells; row.block holds the lights to choose from.
    shared::LightTile tile(const TileDepths& depths, const glm::vec4& rays, RowLists& row) const {
        const auto cell = std::uint32_t(row.cells.size());
        const shared::LightTile oneCell{{cell, ONE_LIGHT_SLICE, 1u, 0u}};
        const shared::CellBox whole = box(rays, depthRun(depths, input.frame));
        if (input.method == Method::TileMinmax || std::has_single_bit(depths.slices)) {
            appendCell(row.block, {&whole, 1}, row);
            return oneCell;
        }
        Boxes boxes;
        const std::size_t count = occupiedBoxes(rays, depths, boxes);
        if (input.method == Method::Tile25d) {
            appendCell(row.block, {boxes.data(), count}, row);
            return oneCell;
        }
        // What misses the tile as a whole misses each of its slices.
        row.block.mark({&whole, 1});
        row.block.copyMarkedTo(row.tile);
        for (std::size_t i = 0; i < count; ++i) appendCell(row.tile, {&boxes[i], 1}, row);
        return {{cell, depths.slicing, std::uint32_t(depths.slices), std::uint32_t(depths.slices >> 32)}};
    }

    void row(const TileSpans& spans, const TileDepths* depths, std::uint32_t tileRow, RowLists& row,
             shared::LightTile* tiles) const {
        row.cells.clear();
        row.entries.clear();
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

    // ---- By normals: what lies behind all surfaces of a cell is taken from its lists.

    std::size_t cellsOf(const TileDepths& depths) const {
        return infoOf(input.method).oneListATile ? 1 : std::size_t(std::popcount(depths.slices));
    }

    PixelRect pixels(const glm::uvec2& place) const {
        const std::size_t side = grid.sidePixels, width = grid.sizePixels.x, height = grid.sizePixels.y;
        const std::size_t left = place.x * side, below = std::min(height, (place.y + 1) * side);
        return {left, std::min(width, left + side), height - below, height - place.y * side};
    }

    /// Sets row.fronts of a tile: one for each of its cells, or several of its only one.
    void findFronts(const SurfacePictures& pictures, const TileDepths& depths, const glm::uvec2& place,
                    RowLists& row) const {
        const bool bySlice = cellsOf(depths) > 1;
        if (bySlice)
            findNormalsBySlice(pictures, pixels(place), depths, input.frame.view.depthKey.x, row.normals);
        else
            findNormals(pictures, pixels(place), row.normals);
        Boxes boxes;
        const glm::vec4 rays = grid.rays(place.x, place.y);
        std::size_t count = 1;
        if (input.method == Method::TileMinmax)
            boxes[0] = box(rays, depthRun(depths, input.frame));
        else
            count = occupiedBoxes(rays, depths, boxes);
        row.fronts.clear();
        for (std::size_t i = 0; i < count; ++i) row.fronts.emplace_back(boxes[i], row.normals[bySlice ? i : 0]);
    }

    /// Moves the lights of `run` that are in front to row.entries[kept] and following ones.
    void keepInFront(const glm::uvec2& run, std::span<const Front> fronts, std::size_t& kept, RowLists& row) const {
        const auto keep = [&](const auto& isInFront) {
            for (std::uint32_t entry = run.x; entry < run.x + run.y; ++entry) {
                const std::uint32_t light = row.entries[entry];
                row.entries[kept] = light;
                kept += isInFront(places[light]) ? 1 : 0;
            }
        };
        if (fronts.size() == 1)
            keep([front = fronts[0]](const glm::vec4& place) { return front.sees(place); });
        else
            keep([&](const glm::vec4& place) {
                return std::ranges::any_of(fronts, [&](const Front& front) { return front.sees(place); });
            });
    }

    void cullByNormals(const SurfacePictures& pictures, const TileDepths* depths, std::uint32_t tileRow,
                       RowLists& row) const {
        std::size_t kept = 0, cell = 0;
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            if (depths[column].isEmpty()) continue;
            const std::span<glm::uvec2> cells(row.cells.data() + cell, cellsOf(depths[column]));
            cell += cells.size();
            const std::size_t entries = cells.back().x + cells.back().y - cells.front().x;
            const bool isWorth =
                input.normalTest == NormalTest::Everywhere || entries >= kLightsWorthNormals * cells.size();
            if (isWorth) findFronts(pictures, depths[column], {column, tileRow}, row);
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const glm::uvec2 run = std::exchange(cells[i], glm::uvec2(std::uint32_t(kept), 0u));
                if (isWorth) {
                    keepInFront(run, cells.size() > 1 ? std::span<const Front>(&row.fronts[i], 1) : row.fronts, kept,
                                row);
                } else {
                    const auto first = row.entries.begin() + run.x;
                    if (kept != run.x) std::copy(first, first + run.y, row.entries.begin() + std::ptrdiff_t(kept));
                    kept += run.y;
                }
                cells[i].y = std::uint32_t(kept) - cells[i].x;
            }
        }
        row.entries.resize(kept);
    }

    /// Whether the lists of opaque surfaces are long enough.
    bool isWorthNormals(std::span<const RowLists> rows) const {
        if (input.normalTest != NormalTest::WhereWorth) return input.normalTest == NormalTest::Everywhere;
        std::size_t entries = 0, cells = 0;
        for (const RowLists& row : rows) {
            entries += row.entries.size();
            cells += row.cells.size();
        }
        return entries > 0 && entries >= kLightsWorthNormals * cells;
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
            if (tile.words.z == 0) continue; // shows nothing
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
    Build build{input, tileGrid(input.frame), {}};
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
    const std::span<RowLists> opaque(scratch_->rows.data(), build.grid.rows);
    if (build.isWorthNormals(opaque)) {
        scratch_->places.clear();
        for (const shared::CullLight& light : input.lights)
            scratch_->places.push_back(shared::placeOfLight(light, input.frame.view.depthKey));
        build.places = scratch_->places;
        const NormalPicture normals = input.readNormals();
        const SurfacePictures pictures{input.opaque.depth, normals, build.grid.sizePixels.x};
        tbb::parallel_for(0u, build.grid.rows, [&](std::uint32_t row) {
            build.cullByNormals(pictures, scratch_->depths.data() + row * build.grid.columns, row, opaque[row]);
        });
    }
    joinRows(build, scratch_->spans.everywhere(), scratch_->rows, lists);
    return lists;
}

} // namespace tessera::culling
