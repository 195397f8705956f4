#include "viewer/session/MapChoices.h"

#include <filesystem>

#include "scenes/Load.h"

namespace tessera::viewer {

std::vector<MapChoice> mapChoices(const State& state) {
    const std::string none(scenes::kNoEnvironment);
    std::vector<MapChoice> choices{{none, "", none, "nothing but lights"}};
    for (const scenes::BuiltinEnvironment& builtin : scenes::builtinEnvironments()) {
        const std::string name(builtin.name);
        choices.push_back({name, std::string(scenes::kBuiltinPrefix) + name, name, std::string(builtin.purpose)});
    }
    for (const std::string& file : state.maps)
        choices.push_back({file, file, std::filesystem::path(file).filename().string(), file});
    return choices;
}

void noteMap(std::vector<std::string>& maps, const scenes::Scene& scene) {
    if (!scene.environment || scene.environment->source.starts_with(scenes::kBuiltinPrefix)) return;
    addRecent(maps, scene.environment->source);
}

} // namespace tessera::viewer
