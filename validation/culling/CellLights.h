#pragma once
#include <cstdint>
#include <vector>

#include "validation/culling/VisitedLights.h"

namespace tessera::validation {

/// How many lights the cells of a frame hold. Each cell counts once, however many pixels lie in it.
struct CellFigures {
    std::size_t count = 0;
    double mean = 0.0;
    std::uint64_t p99 = 0, max = 0;
};

/// Collects cells as pixels come upon them, any number of times each.
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
