#pragma once
#include <glm/glm.hpp>

/// Reference values of the built-in scene `shadow_truth`: two lights with a size, whose visible fractions at points of
/// the ground are known.
namespace tessera::scenes::builtin {

/// Indices of the scene's lights.
enum class ShadowTruthLight { Lamp, Sun };

/// The straight edge of a plate hides part of the lamp's disk: a segment of a circle.
inline constexpr glm::dvec3 kTruthLampWS{-1.2, 2.5, 0.0};
inline constexpr double kTruthLampRadiusMetres = 0.3;
inline constexpr double kTruthPlateY = 1.0;      ///< metres
inline constexpr double kTruthPlateEdgeX = -2.0; ///< the plate lies at smaller x

/// A round disk that faces the sun hides part of it: seen from the ground both are circles, which overlap.
inline constexpr glm::dvec3 kTruthSunTravelWS{0.3, -1.0, 0.2}; ///< not unit
inline constexpr double kTruthSunAngularRadiusDegrees = 8.0;
inline constexpr glm::dvec3 kTruthDiskWS{2.2, 1.2, 0.0};
inline constexpr double kTruthDiskRadiusMetres = 0.5;

/// Visible fraction of the light's disk at a point of the ground, y = 0; valid for the lamp if |z| <= 1.5 and x > -4,
/// for the sun if x > 0.5. `sizes` scales the light's radius, or the tangent of its angular radius.
double shadowTruthShare(ShadowTruthLight light, const glm::dvec3& groundWS, double sizes = 1.0);

} // namespace tessera::scenes::builtin
