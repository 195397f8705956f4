#pragma once
#include <optional>
#include <span>

#include "scenes/Environment.h"
#include "scenes/write/SceneOrigin.h"

namespace tessera::scenes {

/// The .json scene that loadScene() makes `scene` of again, to the last bit, when it is `file`: a reference to the
/// origin, relative to the file's folder, and what may have been edited since: materials that changed, lights, cameras,
/// background and options in full, among them the clip that was chosen. What clips make of materials is no edit.
/// Geometry and pictures must be the origin's. Warnings are not kept, pictures are called by the way to them from the
/// new file, and a scene without lights gets the option that none is supplied. Where a view shows the environment as
/// `seen` says, the file's own lies and shines like that, and its options ask for no such view (askForNoView()). Throws
/// InputError, naming the file, the thing and the remedy, when the scene does not pass checkScene(), when `file` is one
/// that the origin is made of, or when text is not UTF-8. Further cameras come behind the scene's own.
std::string sceneText(const Scene& scene, const SceneOrigin& origin, const std::filesystem::path& file,
                      const std::optional<EnvironmentView>& seen = {}, std::span<const Camera> furtherCameras = {});

/// Takes the wishes away for a view that turns or brightens the environment. A file with options has none of its
/// base's.
void askForNoView(SceneOptions& options);

} // namespace tessera::scenes
