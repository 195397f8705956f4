#pragma once
#include <string>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Adds all of `part` to `whole`, below a new root node called `name` with the transform. Lights and cameras are
/// transformed too; as in KHR_lights_punctual a scale changes no light's intensity or range, and cameras keep their
/// scale of 1. Background and options of `part` are left out. Throws InputError if one of them loses its direction.
void appendScene(Scene& whole, Scene part, const std::string& name, const glm::dmat4& worldFromPart);

} // namespace tessera::scenes
