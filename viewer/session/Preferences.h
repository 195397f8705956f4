#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::viewer {

inline constexpr float kLeastScale = 0.1f; ///< of the image's sides, if set by the user
/// Width of the panels on a display of standard density.
inline constexpr float kUsualPanelWidth = 300.0f, kLeastPanelWidth = 220.0f, kMostPanelWidth = 900.0f;

/// Settings that the viewer saves between runs. Names are those of the command line.
struct Preferences {
    std::vector<std::string> recent; ///< scene files, the latest first
    std::optional<glm::ivec2> windowSize;
    std::map<std::string, std::string, std::less<>> settings; ///< texts, by setting key
    bool automaticScale = true;
    float fixedScale = 1.0f; ///< without automaticScale; kLeastScale to 1
    bool smooths = true;     ///< as State::smooths
    bool showsPanel = true;
    float panelWidth = kUsualPanelWidth;  ///< kLeastPanelWidth to kMostPanelWidth
    std::map<std::string, bool> sections; ///< sections that the user opened or folded, by title
    bool showsMarkers = false;
    bool operator==(const Preferences&) const = default;
};

/// Moves a file to the front of the recent ones; ten are kept.
void addRecent(std::vector<std::string>& recent, const std::string& file);

/// Path of the preferences: $XDG_CONFIG_HOME/tessera/viewer.json or ~/.config, %APPDATA% on Windows,
/// ~/Library/Application Support on macOS; none if the environment defines no such folder.
std::optional<std::filesystem::path> preferencesFile();

/// Reads the preferences; defaults if the file does not exist. Unknown entries and values of the wrong type are
/// ignored. Throws InputError if the file cannot be read or is not JSON.
Preferences readPreferences(const std::filesystem::path& file);

/// Creates the folder if it is missing. Throws std::runtime_error as writeFileAtomically() does.
void writePreferences(const Preferences& preferences, const std::filesystem::path& file);

} // namespace tessera::viewer
