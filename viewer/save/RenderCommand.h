#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/Settings.h"
#include "scenes/CameraChange.h"
#include "scenes/ImportOptions.h"

namespace tessera::viewer {

/// The arguments of `tessera render`: a scene and its frame options.
struct RenderRequest : engine::ViewRequest {
    std::string source;                        ///< the scene's file or name
    std::optional<int> lights;                 ///< as requested for the load
    bool defaultLight = true;                  ///< the same
    bool defaultCamera = false;                ///< the same
    std::optional<std::string> environment;    ///< the same
    std::optional<glm::dvec3> background;      ///< the same
    std::optional<std::string> clip;           ///< the same
    std::vector<scenes::HookValue> hookValues; ///< the same
    scenes::ImportOptions import;              ///< the same
    scenes::CameraChange pose;                 ///< of the camera that the settings select
};

/// The command line, as text for a shell, that renders this and writes the image to `output`: "tessera render hall
/// --size 640x360 -o picture.exr". It lists only settings that differ from the program's defaults and from those the
/// scene itself requests.
std::string renderCommand(const RenderRequest& request, const scenes::Scene& scene, const std::string& output);

} // namespace tessera::viewer
