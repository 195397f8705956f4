#pragma once
#include <span>

#include "scenes/Scene.h"

namespace tessera::scenes::builtin {

/// Adds `count` lights at designed places of a scene. Places are visited in steps of `stride`, coprime to their number,
/// so that any first N are distributed over the whole scene. Further lights are scattered around them within
/// `crowdMetres`. Intensities decrease with the number of lights, so that the image stays as bright.
void addLightsAtPlaces(Scene& scene, std::span<const Light> places, int count, int stride, double crowdMetres);

} // namespace tessera::scenes::builtin
