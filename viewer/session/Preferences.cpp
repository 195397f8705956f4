#include "viewer/session/Preferences.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scenes/Error.h"
#include "validation/AtomicFile.h"

namespace tessera::viewer {
namespace {

using nlohmann::json;

constexpr std::size_t kMostRecent = 10;
constexpr int kSchema = 1;

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

template <typename T>
void readInto(const json& document, const char* key, T& value) {
    const auto found = document.find(key);
    if (found == document.end()) return;
    try {
        value = found->template get<T>();
    } catch (const json::exception&) { // of another version: the usual value stays
    }
}

template <typename T>
void readInto(const json& document, const char* key, std::optional<T>& value) {
    T read{};
    const auto found = document.find(key);
    if (found == document.end()) return;
    try {
        read = found->template get<T>();
    } catch (const json::exception&) {
        return;
    }
    value = read;
}

template <typename T>
void write(json& document, const char* key, const std::optional<T>& value) {
    if (value) document[key] = *value;
}

std::optional<glm::ivec2> sizeOf(const json& document) {
    std::vector<int> size;
    readInto(document, "window", size);
    // Smaller windows were made by mistake, larger ones by a screen that is gone.
    const auto fits = [](int side) { return side >= 200 && side <= 16384; };
    if (size.size() != 2 || !fits(size[0]) || !fits(size[1])) return std::nullopt;
    return glm::ivec2(size[0], size[1]);
}

} // namespace

void addRecent(Preferences& preferences, const std::string& file) {
    std::vector<std::string>& recent = preferences.recent;
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
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw InputError(fmt::format("{}: the settings cannot be read; check the permissions", file.string()));
    const json document = json::parse(text, nullptr, false);
    if (!document.is_object())
        throw InputError(fmt::format("{}: the settings are no JSON object; correct or delete the file", file.string()));
    readInto(document, "recent", preferences.recent);
    preferences.windowSize = sizeOf(document);
    readInto(document, "technique", preferences.technique);
    readInto(document, "layout", preferences.layout);
    readInto(document, "culling", preferences.culling);
    readInto(document, "toneMap", preferences.toneMap);
    readInto(document, "tile", preferences.tile);
    readInto(document, "samples", preferences.samples);
    readInto(document, "automaticScale", preferences.automaticScale);
    readInto(document, "showsPanel", preferences.showsPanel);
    readInto(document, "showsMarkers", preferences.showsMarkers);
    return preferences;
}

void writePreferences(const Preferences& preferences, const std::filesystem::path& file) {
    json document;
    document["schema"] = kSchema;
    document["recent"] = preferences.recent;
    if (preferences.windowSize) document["window"] = {preferences.windowSize->x, preferences.windowSize->y};
    write(document, "technique", preferences.technique);
    write(document, "layout", preferences.layout);
    write(document, "culling", preferences.culling);
    write(document, "toneMap", preferences.toneMap);
    write(document, "tile", preferences.tile);
    write(document, "samples", preferences.samples);
    document["automaticScale"] = preferences.automaticScale;
    document["showsPanel"] = preferences.showsPanel;
    document["showsMarkers"] = preferences.showsMarkers;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
        throw std::runtime_error(fmt::format("cannot make the folder {}: {}; check the permissions above it",
                                             file.parent_path().string(), error.message()));
    validation::writeFileAtomically(file.string(), document.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace tessera::viewer
