#include "viewer/show/MaterialOutline.h"

#include <utility>
#include <vector>

#include "renderer/gpu/Bands.h"
#include "renderer/graph/Execute.h"
#include "viewer/show/KeepsUnused.h"

namespace tessera::viewer {
namespace {

/// By mesh instance in document order: whether it has the material.
std::vector<std::uint8_t> instancesOf(const scenes::Scene& scene, int material) {
    std::vector<std::uint8_t> haveIt;
    for (const scenes::Node& node : scene.nodes)
        for (const scenes::MeshInstance& instance : node.instances) haveIt.push_back(instance.material == material);
    return haveIt;
}

/// Whether images of a view show the scene's surfaces, like the ids view. While a hook moves vertices too far, only the
/// view that marks them can be drawn.
bool showsSurfaces(frame::DebugView view) {
    return view != frame::DebugView::ShadowAtlas && view != frame::DebugView::MovedTooFar;
}

} // namespace

std::optional<MaterialOutline::Sight> MaterialOutline::sightOf(const State& state, const Look& look) {
    if (!state.open || !state.showsMaterial || !showsSurfaces(look.settings.view)) return std::nullopt;
    const scenes::Scene& scene = state.open->scene();
    if (state.selectedMaterial < 0 || std::size_t(state.selectedMaterial) >= scene.materials.size())
        return std::nullopt;
    Sight sight{state.open.get(), state.selectedMaterial, look.settings.sizePixels,
                scene.cameras[std::size_t(state.open->camera())], state.open->geometryRevision()};
    if (scene.hook) {
        sight.timeSeconds = look.settings.timeSeconds;
        sight.hookParameters = scene.hook->parameters;
    }
    return sight;
}

bool MaterialOutline::update(Facts& facts, const State& state, Screen& screen, const Look& look, bool isAtRest,
                             const std::function<bool()>& givesUp) {
    awaitsRest_ = false;
    const std::optional<Sight> sight = screen.picture(0).isThere() ? sightOf(state, look) : std::nullopt;
    bool isChanged = false;
    if (sight != found_) {
        found_.reset();
        isChanged = std::exchange(facts.materialOutline, std::nullopt).has_value();
    }
    if (!sight || (found_ && materialRevision_ == state.open->materialRevision())) return isChanged;
    awaitsRest_ = true;
    if (!isAtRest) return isChanged;
    const std::uint64_t revision = state.open->materialRevision();
    try {
        find(facts, screen, look, *sight, givesUp);
    } catch (const graph::Interrupted&) {
        return isChanged;
    } catch (...) {
        found_ = sight;
        materialRevision_ = revision;
        awaitsRest_ = false;
        throw;
    }
    found_ = sight;
    materialRevision_ = revision;
    awaitsRest_ = false;
    return true;
}

void MaterialOutline::find(Facts& facts, Screen& screen, Look look, const Sight& sight,
                           const std::function<bool()>& givesUp) {
    frame::FrameSettings& settings = look.settings;
    settings.sizePixels = sight.sizePixels;
    settings.wholePixels.reset();
    settings.samples = 1;
    settings.samplePlaces.clear();
    settings.view = frame::DebugView::Ids;
    settings.idsOfNearest = true;
    settings.display = false;
    {
        const KeepsUnused keeps(screen.renderer()->backend());
        const gpu::BandedDrawing banded(givesUp);
        screen.renderer()->draw(engine::Technique::Forward, settings);
    }
    const engine::RenderedFrame ids = screen.renderer()->download();
    const std::vector<std::uint8_t> haveIt = instancesOf(sight.open->scene(), sight.material);
    std::vector<std::uint8_t> isInside(ids.radiance.size() / 4);
    for (std::size_t pixel = 0; pixel < isInside.size(); ++pixel) {
        const auto instance = std::size_t(ids.radiance[4 * pixel]); // counted from 1
        isInside[pixel] = instance > 0 && instance <= haveIt.size() && haveIt[instance - 1] != 0;
    }
    facts.materialOutline = {sight.material, sight.sizePixels, contoursOf(isInside, sight.sizePixels)};
}

} // namespace tessera::viewer
