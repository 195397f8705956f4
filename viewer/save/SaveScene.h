#pragma once
#include <string>

#include "scenes/write/SceneText.h"

namespace tessera::viewer {

/// Writes a scene as a .json file that loads back identically (scenes::sceneText), whole or not at all. Throws
/// InputError for a name that is no .json file and for what sceneText() refuses, std::runtime_error when writing fails;
/// an earlier file of that name then stays.
void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin);

} // namespace tessera::viewer
