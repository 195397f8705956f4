#include "apps/OnePicture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/frame/LightRounds.h"
#include "scenes/InUse.h"
#include "validation/compare/ReferencePicture.h"

namespace tessera::app {

namespace {

/// Whether the material factors make every surface fully transparent, whatever the textures.
bool isAllClear(const scenes::Scene& scene) {
    const auto isClear = [&](const scenes::MeshInstance& instance) {
        if (instance.material == scenes::kNone) return false;
        const scenes::Material& material = scene.materials[std::size_t(instance.material)];
        const float opacity = material.baseColor.w;
        return (material.alphaMode == scenes::AlphaMode::Blend && opacity <= 0.0f) ||
               (material.alphaMode == scenes::AlphaMode::Mask && opacity < material.alphaCutoff);
    };
    return std::ranges::all_of(scene.nodes,
                               [&](const scenes::Node& node) { return std::ranges::all_of(node.instances, isClear); });
}

} // namespace

std::string faultOf(const scenes::Scene& scene, frame::DebugView view, std::span<const float> rgba,
                    const std::string& cut) {
    std::size_t covered = 0, bad = 0;
    bool hasNaN = false;
    // Black is expected without lights, and the scene's warnings name black materials.
    bool isBlack = view == frame::DebugView::Final && !scene.lights.empty() && !scenes::isAllBlack(scene);
    for (std::size_t pixel = 0; pixel < rgba.size(); pixel += 4) {
        covered += rgba[pixel + 3] > 0.0f;
        bad += !(std::isfinite(rgba[pixel]) && std::isfinite(rgba[pixel + 1]) && std::isfinite(rgba[pixel + 2]));
        hasNaN = hasNaN || std::isnan(rgba[pixel]);
        isBlack = isBlack && rgba[pixel] == 0.0f && rgba[pixel + 1] == 0.0f && rgba[pixel + 2] == 0.0f;
    }
    if (bad > 0) {
        const std::string why =
            scene.hook ? fmt::format("a light is too bright or too near, or a loop of its hook takes more than the {} "
                                     "iterations that a pixel may take; dim or move the light, or shorten the loop",
                                     frame::kMostHookIterations)
                       : "a light is too bright or too near; dim it or move it away";
        return fmt::format("{} of its pixels are infinite or no numbers; {}", bad, hasNaN && !cut.empty() ? cut : why);
    }
    if (covered > 0)
        return isBlack ? "is black: no light reaches the surfaces in view; --view diffuse shows them without light, "
                         "and lights may be out of range, behind the surfaces or off"
                       : "";
    if (scenes::triangleCount(scene) == 0) return "the scene has no triangles to draw";
    if (isAllClear(scene))
        return "all surfaces of the scene are transparent: their opacity is 0, or below the cutoff of their alpha mode "
               "mask";
    return fmt::format("the camera sees nothing of the scene; {}check --eye, --target, --near and --far; backs of "
                       "one-sided surfaces, triangles without area and what is smaller than a pixel do not show",
                       scene.supplied.camera ? "" : "give --default-camera, which sees all of it, or ");
}

void settleForReference(const FrameOptions& options, frame::FrameSettings& settings) {
    // As compare does; hardware filtering is available on request.
    if (!options.said("filter")) settings.filter = frame::TextureFilter::Exact;
    validation::requireReferenceSupports(settings);
}

namespace {

/// Why the reference ignores a given option; empty: it may change the image.
std::string whyUnusedByReference(const engine::Setting& setting, const Request& request) {
    if (setting.panel == engine::SettingPanel::Shadows && setting.key != "shadows")
        return "The reference follows rays of its own";
    if (setting.panel == engine::SettingPanel::Skin && setting.key != "subsurface")
        return "The reference integrates over the surface";
    if (setting.usedBy != nullptr && !setting.isDefault(request))
        return "The reference follows a ray a pixel, without passes";
    if (std::string why = whyUnused(setting, request); !why.empty()) return why;
    const bool isOfItsLight = setting.key == "environmentSamples" || setting.ofAreaLights;
    return isOfItsLight ? "The reference integrates in its own way" : "";
}

} // namespace

std::vector<std::string> unusedByReference(const FrameOptions& options, const Request& request) {
    std::vector<std::string> messages;
    for (const engine::Setting& setting : engine::settingTable()) {
        if (!options.said(setting.key)) continue;
        if (const std::string why = whyUnusedByReference(setting, request); !why.empty())
            messages.push_back(unusedText(setting, why));
    }
    return messages;
}

} // namespace tessera::app
