#pragma once
#include "scenes/Scene.h"

/// The scenes that image cases vary, and helpers to modify them.
namespace tessera::validation {

/// Tolerance of a frame of balls against the reference.
inline constexpr double kBallTolerance = 1e-3;
inline constexpr const char* kBallReason = "fp32 lighting of the same surface, most of it 3e-6: where n.v or n.l is "
                                           "near 0 at a ball's edge it keeps fewer digits";

/// A floor 4 m wide with a ball and a slanted board of every lit material model on it, one point and one spot light,
/// and a camera 5 m away with all of it in view. The world origin is in the middle of the floor.
scenes::Scene stressScene();

/// Only the floor, white lambert, filling the view of an orthographic camera 2 m above it that sees one metre to each
/// side.
scenes::Scene stressFloor();

/// An unlit floor 1 m wide, centred at the world origin, that fills the view of a camera at `eyeMetres`.
scenes::Scene stressFarFloor(double eyeMetres);

/// A glossy ball 1 m wide at the world origin, viewed from `eyeMetres`, with lights of 0.4 m range around it.
scenes::Scene stressFarBall(double eyeMetres, int lights);

/// Scales the scene, then moves it: its image stays the same, up to rounding.
void moveScene(scenes::Scene& scene, double scale, const glm::dvec3& offsetWS);

scenes::Light stressLight(const glm::dvec3& positionWS, float candela);

/// Adds an image of 8 x 8 equal texels; returns its index.
int addUniformImage(scenes::Scene& scene, const glm::ivec4& texel);

} // namespace tessera::validation
