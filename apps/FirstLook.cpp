#include "apps/FirstLook.h"

#include <spdlog/spdlog.h>

#include "base/Error.h"

namespace tessera::app {
namespace {

/// Tiled and clustered techniques respond to input several times sooner than a loop over all lights.
constexpr engine::Technique kFirstTechnique = engine::Technique::ClusteredDeferred;

/// The options, with remembered values where neither they nor the scene's file set one.
FrameOptions withRemembered(FrameOptions options, const viewer::Preferences& remembered, const scenes::Scene& scene) {
    for (const engine::Setting& setting : engine::settingTable()) {
        const auto known = remembered.settings.find(setting.key);
        const std::string key(setting.key);
        const bool isOfFile = scene.options.requested.contains(key) && !scene.supplied.requested.contains(key);
        const bool isRequested = options.said(setting.key) || isOfFile;
        if (!setting.isRemembered || isRequested || known == remembered.settings.end()) continue;
        try {
            engine::ViewRequest tried;
            setting.read(tried, known->second);
            options.settings.insert(*known);
        } catch (const InputError& error) {
            spdlog::debug("a remembered setting is left out: {}", error.what());
        }
    }
    return options;
}

} // namespace

viewer::FirstLook firstLook(const FrameOptions& said, const viewer::Preferences& remembered, const scenes::Scene& scene,
                            const std::string& source) {
    FrameOptions options = withRemembered(said, remembered, scene);
    options.scene = source;
    Request request = resolveWithoutScene(options);
    request.scene.name = scene.name;
    request.scene.options = scene.options;
    request.scene.cameras = scene.cameras;
    request.scene.lights.resize(scene.lights.size()); // only their number is used
    if (!options.said("technique")) request.technique = kFirstTechnique;
    resolveForScene(options, request);
    return {viewer::possible({request, {}}), options.pose};
}

FrameOptions forAnyScene(FrameOptions said) {
    for (const engine::Setting& setting : engine::settingTable())
        if (setting.isOfScene) said.settings.erase(std::string(setting.key));
    // Rotation and intensity apply to the first scene's environment only; files saved from it already contain them.
    for (const std::string_view key : scenes::kEnvironmentViewKeys) said.settings.erase(std::string(key));
    said.defaultCamera = false;
    said.pose = {};
    said.lights.reset();
    said.import.variant.reset();
    return said;
}

} // namespace tessera::app
