#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

/// The points at which a pixel meets surfaces that its scene's hook changes. First they are asked for, with all that a
/// pixel does except lighting; once all pixels' are known in one go, the surfaces are lit.
class HookPoints {
public:
    /// Notes the point, or where points are known changes the surface as the hook says, within what a surface may be.
    void change(const Hit& hit, SurfacePoint& point);

    bool areKnown() const { return areKnown_; }
    std::span<const scenes::HookPoint> asked() const { return asked_; }
    /// As many as were asked for.
    void know(std::span<const scenes::HookedSurface> surfaces) {
        known_.assign(surfaces.begin(), surfaces.end());
        areKnown_ = true;
    }

private:
    std::vector<scenes::HookPoint> asked_; ///< each once
    std::vector<scenes::HookedSurface> known_;
    std::size_t next_ = 0; ///< where the search for a point begins: they are met in the order in which they were asked
    bool areKnown_ = false;
};

} // namespace tessera::reference
