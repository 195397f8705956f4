#pragma once
#include <string>

#include "scenes/write/SceneText.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// What names of files call a scene: the stem of its own file, without what a file that was saved before has around it.
std::string savedStem(const std::string& source);

/// Writes a scene as a .json file that loads back identically but for what `seen` says (scenes::sceneText), with the
/// viewpoints that were stored of it as further cameras, whole or not at all. Throws InputError for a name that is no
/// .json file and for what sceneText() refuses, std::runtime_error when writing fails; an earlier file of that name
/// then stays.
void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin,
               const scenes::EnvironmentView& seen, std::span<const scenes::Camera> viewpoints = {});

/// Saves the open scene with its edits, current camera, clip and time, and its environment as it is turned and
/// brightened. From then on that file is the open scene, and the first of the recent ones; the environment is the
/// file's, and the looks leave it as it is. Throws as saveScene() does; then nothing has changed.
void saveOpenScene(State& state, const std::string& path);

} // namespace tessera::viewer
