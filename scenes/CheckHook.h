#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes {

/// Checks Scene::hook, as a part of checkScene() after the nodes. Throws InputError that names the scene.
void checkHook(const Scene& scene);

} // namespace tessera::scenes
