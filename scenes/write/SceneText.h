#pragma once
#include <optional>
#include <span>

#include "scenes/Environment.h"
#include "scenes/write/SceneOrigin.h"

namespace tessera::scenes {

/// The text of a .json scene `file` that loadScene() reads back as `scene`, bit for bit: a reference to the origin,
/// relative to the file's folder, and everything that may have been edited: changed materials, and all lights, cameras,
/// background and options, including the chosen clip. Material values animated by clips are not edits. Geometry and
/// images must be the origin's. Warnings are not kept, images are named by their path from the new file, and a scene
/// without lights gets the option to supply none. With a view `seen`, the stored environment includes its rotation and
/// intensity, and the options omit it (removeEnvironmentView()). Throws InputError, naming the file, the element and
/// the remedy, if the scene does not pass checkScene(), if `file` belongs to the origin, or if text is not UTF-8.
/// Further cameras follow the scene's own.
std::string sceneText(const Scene& scene, const SceneOrigin& origin, const std::filesystem::path& file,
                      const std::optional<EnvironmentView>& seen = {}, std::span<const Camera> furtherCameras = {});

/// Removes the options that rotate or brighten the environment. A file with options inherits none of its base's.
void removeEnvironmentView(SceneOptions& options);

} // namespace tessera::scenes
