#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes {

/// The part of checkScene() that concerns Scene::hook, for a scene whose nodes are checked. Throws InputError that
/// names the scene.
void checkHook(const Scene& scene);

} // namespace tessera::scenes
