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

/// The initial view of a scene.
struct FirstLook {
    Look look;
    scenes::CameraChange pose; ///< of the look's camera
};

struct ViewerOptions {
    std::string scene;        ///< opened first
    scenes::LoadOptions load; ///< for the first scene
    /// Settings of the command line, else of the scene's options, else of the preferences, else the defaults; for later
    /// scenes without settings that name parts of the first one. Throws InputError if the scene lacks something
    /// requested.
    std::function<FirstLook(const scenes::Scene& scene, const std::string& source, bool first)> lookOf;
    glm::ivec2 windowSize{1280, 800};      ///< screen coordinates
    std::optional<glm::ivec2> pictureSize; ///< instead, on a display of standard density: image size beside the panels
    Preferences preferences;               ///< of earlier runs
    std::optional<std::filesystem::path> preferencesFile; ///< where they are saved; none: not saved
    bool log = false;                                     ///< a line on stdout per event
    /// Receives errors after the window has closed.
    std::function<void(const std::string& text)> warn = [](const std::string&) {};
};

} // namespace tessera::viewer
