#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

inline constexpr float kLeastScale = 0.1f; ///< of a picture's side, where the user sets it
/// Width of the panels, on a display of usual density.
inline constexpr float kUsualPanelWidth = 300.0f, kLeastPanelWidth = 220.0f, kMostPanelWidth = 900.0f;

/// What the viewer remembers from one run to the next. Names are those of the command line.
struct Preferences {
    std::vector<std::string> recent; ///< scene files, the latest first
    std::optional<glm::ivec2> windowSize;
    std::map<std::string, std::string, std::less<>> settings; ///< texts, by the settings' keys
    bool automaticScale = true;
    float fixedScale = 1.0f; ///< otherwise; kLeastScale to 1
    bool smooths = true;     ///< as State::smooths
    bool showsPanel = true;
    float panelWidth = kUsualPanelWidth;  ///< kLeastPanelWidth to kMostPanelWidth
    std::map<std::string, bool> sections; ///< of the panels, by title: opened or folded by the user
    bool showsMarkers = false;
    bool operator==(const Preferences&) const = default;
};

/// A file that was opened comes first among the recent ones; the oldest of more than ten leaves.
void addRecent(std::vector<std::string>& recent, const std::string& file);

/// Where they are kept: $XDG_CONFIG_HOME/tessera/viewer.json or ~/.config, %APPDATA% on Windows, ~/Library/Application
/// Support on macOS; none where the environment names no such place.
std::optional<std::filesystem::path> preferencesFile();

/// Those of a file; the usual ones where there is none. Unknown entries, and values of the wrong kind, are left out.
/// Throws InputError where the file cannot be read or is no JSON.
Preferences readPreferences(const std::filesystem::path& file);

/// Makes the folder where it lacks. Throws std::runtime_error as writeFileAtomically() does.
void writePreferences(const Preferences& preferences, const std::filesystem::path& file);

} // namespace tessera::viewer
