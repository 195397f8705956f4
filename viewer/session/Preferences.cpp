#include "viewer/session/Preferences.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "engine/Settings.h"

namespace tessera::viewer {
namespace {

using nlohmann::json;

constexpr std::size_t kMostRecent = 10;
constexpr std::uintmax_t kMostBytes = 1 << 20; ///< hundreds of times what the viewer writes

std::optional<std::filesystem::path> folderNamed(const char* variable) {
    const char* value = std::getenv(variable);
    // A relative path would depend on where the program was started; the XDG specification has it ignored.
    if (value == nullptr || !std::filesystem::path(value).is_absolute()) return std::nullopt;
    return std::filesystem::path(value);
}

std::optional<std::filesystem::path> configurationFolder() {
#if defined(_WIN32)
    return folderNamed("APPDATA");
#else
    const auto home = folderNamed("HOME");
#if defined(__APPLE__)
    if (home) return *home / "Library" / "Application Support";
    return std::nullopt;
#else
    if (auto folder = folderNamed("XDG_CONFIG_HOME")) return folder;
    if (home) return *home / ".config";
    return std::nullopt;
#endif
#endif
}

/// Members of the file besides settings: calls the visitor with each name and member.
template <typename Known, typename Visitor>
void visitPreferences(Known& preferences, Visitor&& visit) {
    visit("recent", preferences.recent);
    visit("window", preferences.windowSize);
    visit("automaticScale", preferences.automaticScale);
    visit("fixedScale", preferences.fixedScale);
    visit("smooths", preferences.smooths);
    visit("showsPanel", preferences.showsPanel);
    visit("panelWidth", preferences.panelWidth);
    visit("sections", preferences.sections);
    visit("showsMarkers", preferences.showsMarkers);
}

// Each throws json::exception for a value of the wrong type.

template <typename T>
void readInto(const json& entry, T& value) {
    value = entry.get<T>();
}

template <typename T>
void readInto(const json& entry, std::optional<T>& value) {
    value = entry.get<T>();
}

void readInto(const json& entry, std::optional<glm::ivec2>& size) {
    // Smaller windows were made by mistake, larger ones by a screen that is gone.
    const auto fits = [](double side) { return side >= 200.0 && side <= 16384.0; };
    const auto sides = entry.get<std::array<double, 2>>(); // not int: values out of its range would be undefined
    if (fits(sides[0]) && fits(sides[1])) size = glm::ivec2(int(sides[0]), int(sides[1]));
}

/// The text of a saved setting; none for an invalid value, for example of another version.
std::optional<std::string> settingText(const engine::Setting& setting, const json& entry) {
    if (!entry.is_string() && !entry.is_number()) return std::nullopt;
    const std::string text = entry.is_string() ? entry.get<std::string>() : entry.dump();
    try {
        engine::ViewRequest request;
        setting.read(request, text);
        return text;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

template <typename T>
json written(const T& value) {
    return value;
}

template <typename T>
json written(const std::optional<T>& value) {
    return value ? written(*value) : json();
}

json written(const std::optional<glm::ivec2>& size) {
    return size ? json{size->x, size->y} : json();
}

} // namespace

void addRecent(std::vector<std::string>& recent, const std::string& file) {
    std::erase(recent, file);
    recent.insert(recent.begin(), file);
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

std::optional<std::filesystem::path> preferencesFile() {
    const auto folder = configurationFolder();
    if (!folder) return std::nullopt;
    return *folder / "tessera" / "viewer.json";
}

Preferences readPreferences(const std::filesystem::path& file) {
    Preferences preferences;
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return preferences;
    if (!std::filesystem::is_regular_file(file, error))
        throw InputError(
            fmt::format("{}: is not a regular file, so settings cannot be kept; rename or remove it", file.string()));
    if (std::filesystem::file_size(file, error) > kMostBytes)
        throw InputError(
            fmt::format("{}: is larger than the viewer's settings can be; correct or delete the file", file.string()));
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw InputError(fmt::format("{}: the settings cannot be read; check the permissions", file.string()));
    const json document = json::parse(text, nullptr, false);
    if (!document.is_object())
        throw InputError(fmt::format("{}: the settings are no JSON object; correct or delete the file", file.string()));
    visitPreferences(preferences, [&](const char* name, auto& value) {
        const auto entry = document.find(name);
        if (entry == document.end()) return;
        try {
            readInto(*entry, value);
        } catch (const json::exception&) { // of another version: the default stays
        }
    });
    for (const engine::Setting& setting : engine::settingTable()) {
        const auto entry = document.find(setting.key);
        if (!setting.isRemembered || entry == document.end()) continue;
        if (auto known = settingText(setting, *entry)) preferences.settings.emplace(setting.key, *std::move(known));
    }
    if (preferences.recent.size() > kMostRecent) preferences.recent.resize(kMostRecent);
    if (!(preferences.fixedScale >= kLeastScale && preferences.fixedScale <= 1.0f))
        preferences.fixedScale = Preferences().fixedScale;
    if (!(preferences.panelWidth >= kLeastPanelWidth && preferences.panelWidth <= kMostPanelWidth))
        preferences.panelWidth = kUsualPanelWidth;
    return preferences;
}

void writePreferences(const Preferences& preferences, const std::filesystem::path& file) {
    json document;
    visitPreferences(preferences, [&](const char* name, const auto& value) {
        if (json entry = written(value); !entry.is_null()) document[name] = std::move(entry);
    });
    for (const auto& [key, text] : preferences.settings) document[key] = text;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
        throw std::runtime_error(fmt::format("cannot make the folder {}: {}; check the permissions above it",
                                             file.parent_path().string(), error.message()));
    writeFileAtomically(file.string(), document.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace tessera::viewer
