#pragma once
#include <string>

#include "scenes/write/SceneText.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// The name of a scene in file names: the stem of its file, without the prefix and number of a file saved earlier.
std::string savedStem(const std::string& source);

/// Writes a scene as a .json file that loads back identically except for the view `seen` (scenes::sceneText), with its
/// stored viewpoints as further cameras. The file is written completely or not at all. Throws InputError for names
/// without .json and for what sceneText() refuses, std::runtime_error if writing fails; an earlier file then stays.
void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin,
               const scenes::EnvironmentView& seen, std::span<const scenes::Camera> viewpoints = {});

/// Saves the open scene with its edits, current camera, clip and time, and its environment as rotated and scaled by the
/// view. Then the file is the open scene and the first recent one; the environment is the file's, and the view no
/// longer changes it. Throws as saveScene() does; then nothing has changed.
void saveOpenScene(State& state, const std::string& path);

} // namespace tessera::viewer
