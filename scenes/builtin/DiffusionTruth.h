#pragma once
#include <glm/glm.hpp>

/// The built-in scene `diffusion_truth` in numbers: two squares of skin under a sun, one half in shadow, one lit
/// through a round hole. On both, light that has spread is known in closed form or as an integral over one distance.
namespace tessera::scenes::builtin {

inline constexpr double kTruthScaleMetres = 0.04; ///< of the real thing that a metre, a side of a square, stands for
inline constexpr double kTruthEdgeX = -0.6;       ///< the sun reaches what lies beyond, on the first square
inline constexpr glm::dvec3 kTruthDotWS{0.6, 0.0, 0.0}; ///< middle of the dot, on the second
inline constexpr double kTruthDotRadiusMetres = 0.02;

/// Share of the sun's light that leaves the first square so far beyond the edge, by channel.
glm::dvec3 spreadStep(double beyondMetres);
/// The same of the second, so far from the middle of the dot. By quadrature, to 1e-6.
glm::dvec3 spreadDot(double distanceMetres);

} // namespace tessera::scenes::builtin
