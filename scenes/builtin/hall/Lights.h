#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes::builtin::hall {

/// Adds `count` point lights. The first 256 places are designed; further lights are scattered around them, and
/// intensities decrease so that the image stays as bright.
void addPointLights(Scene& scene, int count);

/// Adds the evening sky, which brightens all of the hall, and the sun, which casts shadows and enters by the windows.
void addOutdoorLights(Scene& scene);

/// Makes the 16 lamps nearest to `eyeWS` cast shadows.
void castShadowsOfNearest(Scene& scene, const glm::dvec3& eyeWS);

} // namespace tessera::scenes::builtin::hall
