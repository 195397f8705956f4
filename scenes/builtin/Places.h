#pragma once
#include <span>

#include "scenes/Scene.h"

namespace tessera::scenes::builtin {

/// Adds `count` lights to a scene that has designed places for them. The first places are taken in steps of `stride`,
/// which must have no factor in common with their number, so that any first N are spread over the whole scene; more
/// lights crowd around them within `crowdMetres`. All grow weaker so that the picture stays as bright.
void addLightsAtPlaces(Scene& scene, std::span<const Light> places, int count, int stride, double crowdMetres);

} // namespace tessera::scenes::builtin
