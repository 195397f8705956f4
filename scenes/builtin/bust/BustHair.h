#pragma once
#include <glm/glm.hpp>

/// The bust's hair: snail curls, as archaic and Roman sculptors cut them.
namespace tessera::scenes::builtin {

struct BustCurl {
    double height = 0.0; ///< of the curl's dome above the hair's body, bust units
    double groove = 0.0; ///< the spiral cut into it, -1 (bottom) .. 1 (ridge)
    double inside = 0.0; ///< 0 at the curl's border, 1 within
};

/// The curl at a point of the hair (x >= 0).
BustCurl bustCurl(const glm::dvec3& pointBU);

} // namespace tessera::scenes::builtin
