#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes::builtin::hall {

/// Adds `count` point lights. The first 256 places are designed; more lights crowd around them, and all grow weaker so
/// that the picture stays as bright.
void addPointLights(Scene& scene, int count);

/// The evening sky through the windows.
void addSkyLight(Scene& scene);

} // namespace tessera::scenes::builtin::hall
