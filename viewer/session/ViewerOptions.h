#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "scenes/CameraChange.h"
#include "scenes/Load.h"
#include "viewer/session/Look.h"
#include "viewer/session/Preferences.h"

namespace tessera::viewer {

/// How a scene is looked at to begin with.
struct FirstLook {
    Look look;
    scenes::CameraChange pose; ///< of the camera that the look chooses
};

struct ViewerOptions {
    std::string scene;        ///< opened first
    scenes::LoadOptions load; ///< of the first scene
    /// The settings of the command line, else of the scene's options, else of the preferences, else the defaults;
    /// on scenes after the first without what names things of that one. Throws InputError where the scene lacks what
    /// was said.
    std::function<FirstLook(const scenes::Scene& scene, const std::string& source, bool first)> lookOf;
    glm::ivec2 windowSize{1280, 800};      ///< screen coordinates
    std::optional<glm::ivec2> pictureSize; ///< instead, on a display of usual density: what the panels leave
    Preferences preferences;               ///< of the runs before
    std::optional<std::filesystem::path> preferencesFile; ///< where they are kept; none: nowhere
    bool log = false;                                     ///< a line on stdout per event
    /// Receives errors after the window has closed.
    std::function<void(const std::string& text)> warn = [](const std::string&) {};
};

} // namespace tessera::viewer
