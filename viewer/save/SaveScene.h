#pragma once
#include <string>

#include "scenes/write/SceneText.h"

namespace tessera::viewer {

/// What names of files call a scene: the stem of its own file, without what a file that was saved before has around it.
std::string savedStem(const std::string& source);

/// Writes a scene as a .json file that loads back identically (scenes::sceneText), whole or not at all. Throws
/// InputError for a name that is no .json file and for what sceneText() refuses, std::runtime_error when writing fails;
/// an earlier file of that name then stays.
void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin);

} // namespace tessera::viewer
