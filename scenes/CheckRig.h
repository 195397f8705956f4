#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes {

/// Checks Scene::rig, as a part of checkScene() after meshes and nodes. Throws InputError that names the scene and the
/// element.
void checkRig(const Scene& scene);

} // namespace tessera::scenes
