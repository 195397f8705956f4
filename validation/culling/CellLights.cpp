#include "validation/culling/CellLights.h"

#include <algorithm>
#include <numeric>

#include "validation/figures/Percentile.h"

namespace tessera::validation {

CellFigures CellLights::figures() const {
    std::vector<Cell> once = cells_;
    std::ranges::sort(once);
    const auto repeated = std::ranges::unique(once);
    once.erase(repeated.begin(), repeated.end());
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
