#pragma once
#include <glm/glm.hpp>

/// Reference values of the built-in scene `diffusion_truth`: two squares of skin under a sun, one half in shadow, one
/// lit through a round hole. The diffused irradiance is known in closed form or as an integral over one distance.
namespace tessera::scenes::builtin {

inline constexpr double kTruthScaleMetres = 0.04;       ///< real metres per metre of the scene, the side of a square
inline constexpr double kTruthEdgeX = -0.6;             ///< edge of the shadow on the first square; larger x is lit
inline constexpr glm::dvec3 kTruthDotWS{0.6, 0.0, 0.0}; ///< middle of the dot on the second square
inline constexpr double kTruthDotRadiusMetres = 0.02;

/// Fraction of the sun's irradiance that is diffused to the first square at `beyondMetres` beyond the edge, by channel.
glm::dvec3 diffusedStep(double beyondMetres);
/// The same on the second square at `distanceMetres` from the middle of the dot. By quadrature, to 1e-6.
glm::dvec3 diffusedDot(double distanceMetres);

} // namespace tessera::scenes::builtin
