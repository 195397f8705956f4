#include "validation/pictures/ShownPicture.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/Rendering.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/ShadowMaps.h"
#include "shaders/shared/face_colors.h"

namespace tessera::validation {
namespace {

/// "12.3 lights a pixel, at most 40: hall, clustered_deferred".
std::string countTitle(const std::string& counted, const std::string& of, const Picture& counts) {
    double sum = 0.0, covered = 0.0, most = 0.0;
    for (std::size_t i = 0; i < counts.pixelCount(); ++i) {
        if (!counts.covered[i]) continue;
        covered += 1.0;
        sum += counts.pixel(i)[0];
        most = std::max(most, double(counts.pixel(i)[0]));
    }
    // Figures come first: the title of a small image is cut.
    return fmt::format("{:.1f} {} a pixel, at most {:.0f}: {}", sum / std::max(covered, 1.0), counted, most, of);
}

/// The light that single-light views display; null if it casts no shadows.
const engine::DrawnShadows::Light* shownLight(const engine::DrawnShadows& shadows) {
    return shadows.shown ? &shadows.lights[*shadows.shown] : nullptr;
}

int facesOfShown(const engine::DrawnShadows& shadows) {
    const engine::DrawnShadows::Light* const light = shownLight(shadows);
    return light != nullptr && light->sideTexels > 0 ? light->faces : 0;
}

std::string whatHasNoMap(const engine::DrawnShadows& shadows) {
    if (!shadows.hasMaps && !shadows.lights.empty()) return "no maps: shadows are traced";
    if (shownLight(shadows) == nullptr)
        return shadows.lights.empty() ? "no light in view casts shadows" : "the light that is shown casts no shadows";
    return facesOfShown(shadows) == 0 ? "the budget has no room for its maps" : "no map";
}

std::string cascadesTitle(const engine::DrawnShadows& shadows) {
    const int faces = facesOfShown(shadows);
    if (faces == 0) return whatHasNoMap(shadows);
    const engine::DrawnShadows::Light& light = *shownLight(shadows);
    return fmt::format("light {}, {} map{} of {}x{} texels", light.sceneIndex, faces, faces == 1 ? "" : "s",
                       light.sideTexels, light.sideTexels);
}

/// The names of face i, for each kind of light that has one in the atlas.
std::set<std::string> namesInAtlas(const engine::DrawnShadows& shadows, int i) {
    std::set<std::string> names;
    for (const engine::DrawnShadows::Light& light : shadows.lights)
        if (i < light.faces && light.sideTexels > 0) names.insert(frame::shadowFaceName(i, light.faces));
    return names;
}

std::string atlasTitle(const engine::DrawnShadows& shadows) {
    if (!shadows.hasMaps) return whatHasNoMap(shadows);
    return fmt::format("{}x{} texels, {} maps of {}", shadows.atlasTexels.x, shadows.atlasTexels.y, shadows.faces,
                       frame::lightsText(shadows.lights.size()));
}

} // namespace

std::vector<Swatch> shadowSwatches(frame::DebugView view, const engine::DrawnShadows& shadows) {
    std::vector<Swatch> swatches;
    const auto add = [&](int face, std::string meaning) {
        swatches.push_back({codeColour(shared::faceColor(face)), std::move(meaning)});
    };
    if (view == frame::DebugView::Cascades) {
        const int faces = facesOfShown(shadows);
        for (int i = 0; i < faces; ++i) add(i, frame::shadowFaceName(i, faces));
        swatches.push_back({codeColour(shared::noFaceColor()), whatHasNoMap(shadows)});
    }
    if (view == frame::DebugView::ShadowAtlas) {
        for (int i = 0; i < 6; ++i)
            if (const std::set<std::string> names = namesInAtlas(shadows, i); !names.empty())
                add(i, fmt::format("{}", fmt::join(names, " or ")));
    }
    return swatches;
}

DisplayImage shownPicture(const engine::RenderedFrame& frame, const engine::DrawnShadows& shadows,
                          const std::string& sceneName, engine::Technique technique, frame::DebugView view) {
    const std::string of = fmt::format("{}, {}", sceneName, infoOf(technique).name);
    const Picture picture = toPicture(frame);
    switch (view) {
    case frame::DebugView::Lights:
        return countHeatMap(picture, countTitle("lights", of, picture));
    case frame::DebugView::Overdraw:
        return countHeatMap(picture, countTitle("surfaces", of, picture));
    case frame::DebugView::Faults:
        return faultMap(picture, toDisplayImage(frame), of);
    case frame::DebugView::Cascades:
        return paintedMap(toDisplayImage(frame), fmt::format("{}: {}", cascadesTitle(shadows), of),
                          shadowSwatches(view, shadows));
    case frame::DebugView::ShadowAtlas:
        return paintedMap(toDisplayImage(frame), fmt::format("{}: {}", atlasTitle(shadows), of),
                          shadowSwatches(view, shadows));
    default:
        return toDisplayImage(frame);
    }
}

} // namespace tessera::validation
