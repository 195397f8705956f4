#pragma once
#include <glm/glm.hpp>

/// The built-in scene `shadow_truth` in numbers: two lights with a size, whose shares at points of the ground are
/// known.
namespace tessera::scenes::builtin {

/// By number of the scene's lights.
enum class ShadowTruthLight { Lamp, Sun };

/// The lamp stands before the straight edge of a plate; what the plate hides of its disk is a segment of a circle.
inline constexpr glm::dvec3 kTruthLampWS{-1.2, 2.5, 0.0};
inline constexpr double kTruthLampRadiusMetres = 0.3;
inline constexpr double kTruthPlateY = 1.0;      ///< metres
inline constexpr double kTruthPlateEdgeX = -2.0; ///< it lies beside smaller x

/// The sun shines past a round disk that faces it; in the sky both are circles, and what is hidden is where they
/// overlap.
inline constexpr glm::dvec3 kTruthSunTravelWS{0.3, -1.0, 0.2}; ///< not unit
inline constexpr double kTruthSunAngularRadiusDegrees = 8.0;
inline constexpr glm::dvec3 kTruthDiskWS{2.2, 1.2, 0.0};
inline constexpr double kTruthDiskRadiusMetres = 0.5;

/// The share of the light's disk that is in sight of a point of the ground, y = 0; the lamp's where |z| <= 1.5 and x >
/// -4, the sun's where x > 0.5. `sizes`: the light's radius, or the tangent of its angular radius, in those of the
/// scene.
double shadowTruthShare(ShadowTruthLight light, const glm::dvec3& groundWS, double sizes = 1.0);

} // namespace tessera::scenes::builtin
