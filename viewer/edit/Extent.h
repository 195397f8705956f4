#pragma once
#include "scenes/Scene.h"

/// What of a scene a camera is to bring into view.
namespace tessera::viewer {

/// The bounds in world space of all that has a material, as it is posed now; empty where nothing has it.
scenes::Box3 boundsOfMaterial(const scenes::Scene& scene, int material);

/// A box about a light's surface at a time; of one that has none, or a small one, `leastMetres` to either side of its
/// place. Empty where it has no place.
scenes::Box3 boundsOfLight(const scenes::Light& light, double timeSeconds, double leastMetres);

} // namespace tessera::viewer
