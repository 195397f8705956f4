#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes {

/// The part of checkScene() that concerns Scene::rig, for a scene whose meshes and nodes are checked. Throws InputError
/// that names the scene and the element.
void checkRig(const Scene& scene);

} // namespace tessera::scenes
