#pragma once
#include "scenes/Scene.h"

/// Bounds of parts of a scene, for bringing them into view.
namespace tessera::viewer {

/// World bounds of everything that has a material, in the current pose; empty if nothing has it.
scenes::Box3 boundsOfMaterial(const scenes::Scene& scene, int material);

/// A box about a light's surface at a time, extending at least `leastMetres` to each side of its position. Empty if it
/// has no position.
scenes::Box3 boundsOfLight(const scenes::Light& light, double timeSeconds, double leastMetres);

} // namespace tessera::viewer
