#pragma once
#include <compare>
#include <cstdint>
#include <vector>

#include "engine/Renderer.h"

namespace tessera::validation {

/// A cell of the light lists: a tile and one of its depth slices, or of the frame's depth bins. All pixels of a cell
/// visit the same lights. Without culling the whole image is one cell.
struct VisitedCell {
    std::uint32_t tile = 0, slice = 0;
    auto operator<=>(const VisitedCell&) const = default;
};

/// Opaque and transparent surfaces have separate lists.
enum class SurfaceLayer { Opaque, Transparent };

/// Reads a frame's light lists as the shaders' light cursor does, by independent code.
class VisitedLights {
public:
    /// `drawn` must outlive the object.
    explicit VisitedLights(const engine::DrawnLists& drawn);

    /// The cell of a surface. `row` counts from the bottom; `depth` is the surface's depth buffer value.
    VisitedCell cellAt(int column, int row, float depth, SurfaceLayer layer = SurfaceLayer::Opaque) const;

    /// Scene lights that the pixels of a cell visit, ascending, those that reach everywhere included.
    void at(const VisitedCell& cell, std::vector<int>& sceneLights) const;

private:
    void ofList(const VisitedCell& visited, std::vector<int>& sceneLights) const;
    void ofMasks(const VisitedCell& visited, std::vector<int>& sceneLights) const;

    const engine::DrawnLists& drawn_;
};

/// Statistics of the lights per cell of a frame. Each cell counts once, however many pixels lie in it.
struct CellFigures {
    std::size_t count = 0;
    double mean = 0.0;
    std::uint64_t p99 = 0, max = 0;
};

/// Collects the cells of pixels; the same cell may be added many times.
class CellLights {
public:
    void add(const VisitedCell& cell, std::size_t lights) { cells_.push_back({cell, lights}); }
    void add(const CellLights& other) { cells_.insert(cells_.end(), other.cells_.begin(), other.cells_.end()); }

    /// All zero where no cell was added.
    CellFigures figures() const;

private:
    struct Cell {
        VisitedCell cell;
        std::size_t lights;
        auto operator<=>(const Cell&) const = default;
    };
    std::vector<Cell> cells_;
};

} // namespace tessera::validation
