#pragma once
#include "scenes/Scene.h"

/// The scene that picture cases vary, and short forms for what they add to it.
namespace tessera::validation {

/// What a frame of balls is held to against the reference.
inline constexpr double kBallTolerance = 1e-3;
inline constexpr const char* kBallReason = "fp32 lighting of the same surface, most of it 3e-6: where n.v or n.l is "
                                           "near 0 at a ball's edge it keeps fewer digits";

/// A floor 4 m wide with a ball and a slanted board of every lit material model on it, one point and one spot light,
/// and a camera that sees all of it from 5 m away. World origin in the middle of the floor.
scenes::Scene stressScene();

/// Only the floor, filling the picture of a camera that looks straight down at it from 2 m; one metre to each side. Its
/// material is lambert, white.
scenes::Scene stressFloor();

/// A floor 1 m wide, world origin in its middle, that fills the picture of an eye so far away. Nothing lights it.
scenes::Scene stressFarFloor(double eyeMetres);

/// A glossy ball of 1 m about the world's origin, seen from as far, with that many lights of 0.4 m around it.
scenes::Scene stressFarBall(double eyeMetres, int lights);

/// The scene so many times as large, and then moved: its picture is what it was, to rounding.
void moveScene(scenes::Scene& scene, double scale, const glm::dvec3& offsetWS);

scenes::Light stressLight(const glm::dvec3& positionWS, float candela);

/// An image of 8 x 8 texels, all alike.
int addUniformImage(scenes::Scene& scene, const glm::ivec4& texel);

} // namespace tessera::validation
