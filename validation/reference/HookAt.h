#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

/// The points at which a pixel meets surfaces that its scene's hook changes. A first pass collects them, with all of a
/// pixel's work except lighting. The hook then runs once for the points of many pixels, and a second pass lights them.
class HookPoints {
public:
    /// Records the point in the first pass; in the second applies the hook's result, clamped to valid values.
    void change(const Hit& hit, SurfacePoint& point);

    bool areKnown() const { return areKnown_; }
    std::span<const scenes::HookPoint> requested() const { return requested_; }
    /// Sets the hook's results, one for each of requested().
    void know(std::span<const scenes::HookedSurface> surfaces) {
        known_.assign(surfaces.begin(), surfaces.end());
        areKnown_ = true;
    }

private:
    std::vector<scenes::HookPoint> requested_; ///< without duplicates
    std::vector<scenes::HookedSurface> known_;
    std::size_t next_ = 0; ///< start of the search: the second pass meets points in the same order
    bool areKnown_ = false;
};

} // namespace tessera::reference
