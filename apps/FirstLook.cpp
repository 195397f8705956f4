#include "apps/FirstLook.h"

#include <spdlog/spdlog.h>

#include "scenes/Error.h"

namespace tessera::app {
namespace {

/// Tiles and clusters answer input several times sooner than looping over all lights does.
constexpr recipes::Technique kFirstTechnique = recipes::Technique::ClusteredDeferred;

/// The options, with what is remembered where neither they nor the scene say anything.
FrameOptions withRemembered(FrameOptions options, const viewer::Preferences& remembered,
                            const scenes::SceneOptions& wish) {
    const auto fill = [&options](auto member, const auto& value, bool isWished = false) {
        if (options.*member || isWished || !value) return;
        FrameOptions tried = options;
        tried.*member = *value;
        try {
            resolveWithoutScene(tried);
            options = tried;
        } catch (const InputError& error) {
            spdlog::debug("a remembered setting is left out: {}", error.what());
        }
    };
    fill(&FrameOptions::technique, remembered.technique, wish.technique.has_value());
    fill(&FrameOptions::layout, remembered.layout, wish.layout.has_value());
    fill(&FrameOptions::toneMap, remembered.toneMap, wish.toneMap.has_value());
    fill(&FrameOptions::culling, remembered.culling);
    fill(&FrameOptions::tile, remembered.tile);
    fill(&FrameOptions::samples, remembered.samples);
    return options;
}

} // namespace

viewer::FirstLook firstLook(const FrameOptions& said, const viewer::Preferences& remembered, const scenes::Scene& scene,
                            const std::string& source) {
    FrameOptions options = withRemembered(said, remembered, scene.options);
    options.scene = source;
    Request request = resolveWithoutScene(options);
    request.scene.name = scene.name;
    request.scene.options = scene.options;
    request.scene.cameras = scene.cameras;
    request.scene.lights.resize(scene.lights.size()); // their number is all that is asked
    if (!options.technique) request.technique = kFirstTechnique;
    resolveForScene(options, request);
    return {viewer::possible({request.technique, request.settings, {}}), options.pose};
}

FrameOptions forAnyScene(FrameOptions said) {
    said.camera.reset();
    said.pose = {};
    said.solo.reset();
    said.lights.reset();
    return said;
}

} // namespace tessera::app
