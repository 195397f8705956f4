#include "viewer/save/SaveScene.h"

#include <filesystem>
#include <string_view>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Extension.h"
#include "viewer/session/Playback.h"
#include "viewer/session/SceneSource.h"

namespace tessera::viewer {
namespace {

constexpr std::string_view kPrefix = "tessera-";

} // namespace

std::string savedStem(const std::string& source) {
    std::string stem = std::filesystem::path(source).stem().string();
    if (!stem.starts_with(kPrefix)) return stem;
    stem = stem.substr(kPrefix.size());
    const std::size_t number = stem.find_last_not_of("0123456789");
    return number != std::string::npos && stem[number] == '-' && number + 1 < stem.size() ? stem.substr(0, number)
                                                                                          : stem;
}

void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin,
               const scenes::EnvironmentView& seen, std::span<const scenes::Camera> viewpoints) {
    if (extensionOf(path) != ".json") throw InputError(path + ": edited scenes are saved as .json; give such a name");
    writeFileAtomically(path, scenes::sceneText(scene, origin, path, seen, viewpoints));
}

void saveOpenScene(State& state, const std::string& path) {
    OpenScene& open = *state.open;
    scenes::SceneOptions before = open.exchangeOptions(optionsToSave(state));
    try {
        saveScene(path, open.scene(), open.origin(), open.environmentView(), open.viewpoints());
    } catch (...) {
        open.exchangeOptions(std::move(before));
        throw;
    }
    open.becomes(std::filesystem::absolute(path).string());
    state.viewEnvironmentBy(open.environmentView());
    noteRecent(state.recent, open.source());
}

} // namespace tessera::viewer
