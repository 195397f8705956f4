#include "engine/Techniques.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/EnumTable.h"
#include "passes/DeferredLightingPass.h"
#include "passes/DepthPrepass.h"
#include "passes/DisplayPass.h"
#include "passes/ForwardPass.h"
#include "passes/GBufferPass.h"
#include "passes/GpuLightListsPass.h"
#include "passes/IdsPass.h"
#include "passes/LightListsPass.h"
#include "passes/LightVolumesPass.h"
#include "passes/OverdrawPass.h"
#include "passes/ResolvePass.h"
#include "passes/StoredChannelPass.h"
#include "passes/TransparentDepthPass.h"
#include "passes/UploadPass.h"

namespace tessera::engine {

namespace {

using namespace passes;
using graph::TextureHandle;

using culling::Method;
constexpr Method kAllLights[] = {Method::None};
constexpr Method kTiled[] = {Method::Tile25d, Method::TileMinmax, Method::None};
constexpr Method kClustered[] = {Method::Cluster, Method::Zbin, Method::None};

/// What a recipe wires passes with.
struct Recipe {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    const frame::DrawnView* drawn;
    frame::SurfaceHandles surfaces; ///< the scene, as the view draws it
    frame::LightingInputs lighting; ///< with the lists, once there are some

    Recipe(graph::Graph& ofGraph, const frame::FrameSpec& ofSpec, const frame::DrawnView* ofView)
        : graph(ofGraph), spec(ofSpec), drawn(ofView), surfaces(frame::importSurfaces(graph, spec, drawn)) {
        const UploadViewPass::Outputs view = UploadViewPass::add(graph, drawn);
        surfaces.view = {view.constants};
        surfaces.rows = view.rows;
        surfaces.commands = view.commands;
        const UploadLightsPass::Outputs lights = UploadLightsPass::add(graph, spec, drawn);
        lighting = {surfaces.view,
                    lights.constants,
                    lights.lights,
                    lights.shapes,
                    frame::importMaterialTable(graph, spec, drawn),
                    {}};
    }

    bool hasLightLists() const { return spec.culling.method != Method::None; }
    bool blends() const { return spec.features[frame::Feature::Blend]; }
    /// Reduces a multisampled texture to one sample per pixel.
    TextureHandle resolve(TextureHandle samples, ResolvePass::Kind kind) {
        if (spec.samples == 1) return samples;
        return ResolvePass::add(graph, spec, {kind}, {samples}).resolved;
    }
    /// The depths at which visible surfaces are lit: opaque ones at `opaque`, transparent ones in front of `depth`.
    frame::LitDepths litDepths(TextureHandle depth, TextureHandle opaque) {
        frame::LitDepths depths{resolve(opaque, ResolvePass::Kind::Depths), {}};
        if (!blends()) return depths;
        const TextureHandle transparent = TransparentDepthPass::add(graph, spec, {surfaces, depth}).transparentDepth;
        depths.transparent = resolve(transparent, ResolvePass::Kind::TransparentDepths);
        return depths;
    }
    /// The surfaces that a forward technique has lit at `depth`, stored as a deferred one would. Depths of several
    /// samples a pixel tell nothing of its centre, so there the G-buffer gets its own.
    frame::GBufferHandles storeSurfaces(TextureHandle depth) {
        GBufferPass::Inputs inputs{surfaces};
        if (spec.samples == 1) inputs.depth = depth;
        return GBufferPass::add(graph, spec, inputs).gbuffer;
    }
    /// Light lists for the visible surfaces, if the frame culls lights.
    void addLightLists(TextureHandle depth, TextureHandle opaque) {
        if (!hasLightLists()) return;
        const frame::LitDepths depths = litDepths(depth, opaque);
        lighting.lists =
            spec.culling.builder == culling::Builder::Cpu
                ? LightListsPass::add(graph, spec, {depths}, drawn).lists
                : GpuLightListsPass::add(graph, spec, {depths, lighting.view, lighting.constants}, drawn).lists;
    }
};

OpaquePicture opaqueForward(Recipe& recipe) {
    const ForwardPass::Inputs inputs{recipe.surfaces, recipe.lighting, {}, {}};
    const ForwardPass::Outputs lit = ForwardPass::add(recipe.graph, recipe.spec, {}, inputs);
    return {lit.radiance, lit.depth};
}

OpaquePicture opaqueForwardPrepass(Recipe& recipe) {
    const DepthPrepass::Params params{recipe.hasLightLists() && recipe.spec.samples > 1};
    const DepthPrepass::Outputs drawn = DepthPrepass::add(recipe.graph, recipe.spec, params, {recipe.surfaces});
    recipe.addLightLists(drawn.depth, drawn.shadingDepth.value_or(drawn.depth));
    const ForwardPass::Inputs inputs{recipe.surfaces, recipe.lighting, drawn.depth, {}};
    return {ForwardPass::add(recipe.graph, recipe.spec, {}, inputs).radiance, drawn.depth};
}

OpaquePicture opaqueDeferred(Recipe& recipe) {
    const frame::GBufferHandles gbuffer = GBufferPass::add(recipe.graph, recipe.spec, {recipe.surfaces}).gbuffer;
    recipe.addLightLists(gbuffer.depth, gbuffer.depth);
    const DeferredLightingPass::Outputs lit =
        DeferredLightingPass::add(recipe.graph, recipe.spec, {}, {gbuffer, recipe.lighting});
    return {lit.radiance, gbuffer.depth, gbuffer};
}

OpaquePicture opaqueDeferredVolumes(Recipe& recipe) {
    const frame::GBufferHandles gbuffer = GBufferPass::add(recipe.graph, recipe.spec, {recipe.surfaces}).gbuffer;
    const DeferredLightingPass::Params params{.visitsLights = false};
    const TextureHandle unlit =
        DeferredLightingPass::add(recipe.graph, recipe.spec, params, {gbuffer, recipe.lighting}).radiance;
    if (!LightVolumesPass::isNeeded(recipe.spec)) return {unlit, gbuffer.depth, gbuffer};
    const LightVolumesPass::Inputs inputs{gbuffer, recipe.lighting, unlit};
    return {LightVolumesPass::add(recipe.graph, recipe.spec, inputs).radiance, gbuffer.depth, gbuffer};
}

/// A technique, and how it draws opaque surfaces.
struct Row {
    TechniqueInfo info;
    OpaquePicture (*drawOpaque)(Recipe& recipe);
};
constexpr Row kRows[] = {
    {{Technique::Forward, "forward", Geometry::Shaded, "every fragment loops over all lights; the baseline",
      kAllLights},
     opaqueForward},
    {{Technique::ForwardPrepass, "forward_prepass", Geometry::DepthFirst, "each visible pixel once, all lights",
      kAllLights},
     opaqueForwardPrepass},
    {{Technique::Deferred, "deferred", Geometry::GBuffer, "full screen, each covered pixel once, all lights",
      kAllLights, true},
     opaqueDeferred},
    {{Technique::DeferredVolumes, "deferred_volumes", Geometry::GBuffer,
      "one proxy volume a light, depth tested, added by blending", kAllLights, false, true},
     opaqueDeferredVolumes},
    {{Technique::TiledDeferred, "tiled_deferred", Geometry::GBuffer,
      "full screen, each covered pixel once, its tile's lights", kTiled, true},
     opaqueDeferred},
    {{Technique::ForwardPlus, "forward_plus", Geometry::DepthFirst, "each visible pixel once, its tile's lights",
      kTiled},
     opaqueForwardPrepass},
    {{Technique::ClusteredDeferred, "clustered_deferred", Geometry::GBuffer,
      "full screen, each covered pixel once, its cluster's lights", kClustered, true},
     opaqueDeferred},
    {{Technique::ClusteredForward, "clustered_forward", Geometry::DepthFirst,
      "each visible pixel once, its cluster's lights", kClustered},
     opaqueForwardPrepass},
};
constexpr auto kTechniques = [] {
    std::array<TechniqueInfo, std::size(kRows)> infos{};
    std::ranges::transform(kRows, infos.begin(), &Row::info);
    return infos;
}();
static_assert(isInOrder(kTechniques, &TechniqueInfo::technique, kTechniques.size()));

/// A picture that a view shows, and the depth of opaque surfaces.
struct Shown {
    TextureHandle radiance;
    TextureHandle depth;
};

/// The lit picture, transparent surfaces included.
Shown addLitPicture(Technique technique, Recipe& recipe, const AfterOpaque& after) {
    OpaquePicture opaque = kRows[std::size_t(technique)].drawOpaque(recipe);
    // Add passes here that read the opaque picture and draw below transparent surfaces.
    if (after.readsSurfaces && !opaque.gbuffer) opaque.gbuffer = recipe.storeSurfaces(opaque.depth);
    if (after.add) opaque.radiance = after.add(recipe.graph, recipe.spec, opaque);
    if (!recipe.blends()) return {opaque.radiance, opaque.depth};
    const ForwardPass::Params params{ForwardPass::Surfaces::Transparent};
    const ForwardPass::Inputs inputs{recipe.surfaces, recipe.lighting, opaque.depth, opaque.radiance};
    return {ForwardPass::add(recipe.graph, recipe.spec, params, inputs).radiance, opaque.depth};
}

/// What stands in for the lit picture in debug views that passes of their own draw; none for all others.
std::optional<Shown> addDebugView(Technique technique, Recipe& recipe) {
    const frame::DebugView view = recipe.spec.settings.view;
    if (view == frame::DebugView::Ids) {
        const IdsPass::Outputs drawn = IdsPass::add(recipe.graph, recipe.spec, {recipe.surfaces});
        return Shown{drawn.ids, drawn.depth};
    }
    if (view == frame::DebugView::Overdraw) {
        OverdrawPass::Inputs inputs{recipe.surfaces, {}};
        if (infoOf(technique).geometry == Geometry::DepthFirst)
            inputs.depth = DepthPrepass::add(recipe.graph, recipe.spec, {}, {recipe.surfaces}).depth;
        const OverdrawPass::Outputs drawn = OverdrawPass::add(recipe.graph, recipe.spec, inputs);
        return Shown{drawn.overdraw, drawn.depth};
    }
    if (const std::optional<frame::StoredComponents> shown = frame::storedComponents(view)) {
        const frame::GBufferHandles gbuffer = GBufferPass::add(recipe.graph, recipe.spec, {recipe.surfaces}).gbuffer;
        return Shown{StoredChannelPass::add(recipe.graph, recipe.spec, {*shown}, {gbuffer}).radiance, gbuffer.depth};
    }
    return {};
}

} // namespace

std::string_view describe(Geometry geometry) {
    switch (geometry) {
    case Geometry::Shaded:
        return "shaded as it is rasterised";
    case Geometry::DepthFirst:
        return "depth first, then equal depth only";
    case Geometry::GBuffer:
        break;
    }
    return "G-buffer";
}

std::span<const TechniqueInfo> techniqueTable() {
    return kTechniques;
}

const TechniqueInfo& infoOf(Technique technique) {
    return kTechniques[std::size_t(technique)];
}

DeclaredView declareView(graph::Graph& graph, Technique technique, const frame::FrameSpec& spec,
                         const frame::DrawnView* drawn, const AfterOpaque& after) {
    Recipe recipe(graph, spec, drawn);
    std::optional<Shown> shown = addDebugView(technique, recipe);
    if (!shown) shown = addLitPicture(technique, recipe, after);
    DeclaredView view;
    view.radiance = recipe.resolve(shown->radiance, ResolvePass::Kind::Radiance);
    view.depth = shown->depth;
    view.display = DisplayPass::add(graph, spec, {view.radiance}).display;
    view.lists = recipe.lighting.lists;
    graph.output(view.radiance);
    graph.output(view.depth);
    if (spec.settings.display) graph.output(view.display);
    if (view.lists) {
        graph.output(view.lists->tiles);
        graph.output(view.lists->cells);
        graph.output(view.lists->entries);
    }
    return view;
}

} // namespace tessera::engine
