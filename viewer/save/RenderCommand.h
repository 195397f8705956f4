#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/Settings.h"
#include "scenes/CameraChange.h"
#include "scenes/ImportWishes.h"

namespace tessera::viewer {

/// The arguments of `tessera render`: a scene and its frame options.
struct RenderRequest : engine::ViewRequest {
    std::string source;                        ///< the scene's file or name
    std::optional<int> lights;                 ///< number requested of the load
    bool defaultLight = true;                  ///< the same
    bool defaultCamera = false;                ///< the same
    std::optional<std::string> environment;    ///< the same
    std::optional<glm::dvec3> background;      ///< the same
    std::optional<std::string> clip;           ///< the same
    std::vector<scenes::HookValue> hookValues; ///< the same
    scenes::ImportWishes import;               ///< the same
    scenes::CameraChange pose;                 ///< of the camera that the settings choose
};

/// The command line that asks for this and writes the picture to `output`, to paste into a shell: "tessera render hall
/// --size 640x360 -o picture.exr". It names only settings that are neither the program's default nor what the scene
/// itself asks for.
std::string renderCommand(const RenderRequest& request, const scenes::Scene& scene, const std::string& output);

} // namespace tessera::viewer
