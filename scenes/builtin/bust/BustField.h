#pragma once
#include <glm/glm.hpp>

/// The sculpture behind the scenes `head` and `hall`: a bust as an implicit surface, in units of about 10 cm, Y up, the
/// face towards +Z, the middle of the skull near the origin.
namespace tessera::scenes::builtin {

inline constexpr double kBustBottomY = -3.1;
inline constexpr double kBustTopY = 1.24;

/// Approximate distance to the bust's skin, negative inside, without fine relief.
double bustField(const glm::dvec3& pointBU);

/// Fine relief on the skin at a point, along its normal outwards: hair, brows, lips' and skin's texture. In bust units.
/// `grain` scales the pits and unevenness of the bare surface: 1 is weathered stone.
double bustRelief(const glm::dvec3& pointBU, double grain);

/// Weights of the skin's regions at a point, each 0..1, for its colour.
struct BustRegions {
    double hair = 0.0;
    double brow = 0.0;
    double lips = 0.0;
    double eye = 0.0;
    double iris = 0.0; ///< the pupil included
    double irisRim = 0.0;
    double pupil = 0.0;
};
BustRegions bustRegions(const glm::dvec3& pointBU);

} // namespace tessera::scenes::builtin
