#include "engine/Techniques.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

#include <fmt/format.h>

#include "base/EnumTable.h"
#include "passes/BackdropPass.h"
#include "passes/BehindGlassPass.h"
#include "passes/DeferredLightingPass.h"
#include "passes/DepthPrepass.h"
#include "passes/DiffusionPasses.h"
#include "passes/DisplayPass.h"
#include "passes/FarSidesPass.h"
#include "passes/ForwardPass.h"
#include "passes/GBufferPass.h"
#include "passes/GpuLightListsPass.h"
#include "passes/IdsPass.h"
#include "passes/LightListsPass.h"
#include "passes/LightVolumesPass.h"
#include "passes/OverdrawPass.h"
#include "passes/ResolvePass.h"
#include "passes/SeenLightsPass.h"
#include "passes/ShadowAtlasPass.h"
#include "passes/ShadowMapsPass.h"
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

/// Resources that all views of a frame share. declareShared() also declares passes and resources of no single view,
/// such as caches.
struct FrameHandles {
    frame::SceneHandles scene;
};

FrameHandles declareShared(graph::Graph& graph, std::span<const ViewSource> views) {
    const ViewSource& anyView = views.front();
    std::vector<const frame::FrameSpec*> specs;
    for (const ViewSource& view : views) {
        specs.push_back(&view.spec);
        for (const frame::FrameSpec& object : view.spec.diffusionViews) specs.push_back(&object);
    }
    FrameHandles shared{frame::importScene(graph, specs, anyView.drawn ? anyView.drawn->scene : nullptr)};
    shared.scene.environment =
        frame::importEnvironment(graph, specs, anyView.drawn ? anyView.drawn->environment : nullptr);
    shared.scene.lobes = frame::importLobes(graph, specs, anyView.drawn ? anyView.drawn->lobes : nullptr);
    shared.scene.lightPictures = frame::importLightPictures(graph, specs, anyView.drawn);
    return shared;
}

/// The resources that connect the passes of a view.
struct ViewWiring {
    graph::Graph& graph;
    const frame::FrameSpec& spec;
    const frame::DrawnView* drawn;
    frame::SurfaceHandles surfaces;                    ///< the scene, as the view draws it
    frame::LightingInputs lighting;                    ///< with light lists, once built
    std::optional<frame::EnvironmentHandles> backdrop; ///< if the environment is visible
    std::optional<graph::BufferHandle> seenLights;     ///< if area lights are visible: shared::SeenLightTexels
    std::optional<graph::BufferHandle> seenPictures;   ///< if some of those have images
    std::optional<TextureHandle> passingLobes;         ///< lobe table, if transmissive surfaces may be rough

    ViewWiring(graph::Graph& ofGraph, const FrameHandles& frame, const ViewSource& view, std::size_t index)
        : graph(ofGraph), spec(view.spec), drawn(view.drawn) {
        const UploadViewPass::Outputs uploaded = UploadViewPass::add(graph, spec, drawn);
        surfaces = {drawn, frame.scene, {uploaded.constants}, uploaded.rows, uploaded.commands, {}, uploaded.hook, {}};
        if (!spec.features[frame::Feature::Shadows]) surfaces.scene.facetNormals.reset();
        const UploadLightsPass::Outputs lights = UploadLightsPass::add(graph, spec, drawn);
        lighting = {surfaces.view,
                    lights.constants,
                    lights.lights,
                    frame.scene.materialTable,
                    spec.features.subsurfaceRows() ? frame.scene.subsurfaces : std::nullopt,
                    {},
                    {},
                    {},
                    {},
                    {}};
        seenLights = lights.seenLights;
        if (lights.environment) addEnvironment(frame.scene.environment, *lights.environment);
        lighting.lobes.lobes = frame.scene.lobes.lobes;
        if (spec.lightsByLobeTable()) lighting.lobes.table = frame.scene.lobes.table;
        if (spec.passesByLobes) passingLobes = frame.scene.lobes.table;
        if (spec.usesLobeShapes()) lighting.lobes.shapes = frame.scene.lobes.shapes;
        if (spec.features[frame::Feature::LightPictures]) lighting.lightPictures = frame.scene.lightPictures;
        if (spec.showsLightPictures) seenPictures = frame.scene.lightPictures;
        if (lights.casterTree) lighting.casterTree = {*lights.casterTree, frame.scene.casters.value()};
        if (spec.features[frame::Feature::ShadowMaps])
            lighting.shadowAtlas = ShadowMapsPass::add(graph, spec, {frame.scene, drawn, index}).atlas;
        if (spec.features[frame::Feature::SubsurfaceDiffusion])
            surfaces.diffusedLight = addDiffusedLight(frame, view, index);
    }

    void addEnvironment(const frame::EnvironmentHandles& all, graph::BufferHandle constants) {
        if (spec.showsEnvironment) {
            backdrop = frame::EnvironmentHandles{constants, {}, {}, {}};
            if (spec.settings.environment.backdrop == frame::Backdrop::Sharp)
                backdrop->map = all.map;
            else
                backdrop->filtered = all.filtered;
        }
        if (!spec.features[frame::Feature::Environment]) return;
        lighting.environment = frame::EnvironmentHandles{constants, {}, {}, {}};
        if (spec.lightsByEnvironmentMap()) lighting.environment->map = all.map;
        if (spec.usesEnvironmentSamples())
            lighting.environment->samples = all.samples;
        else
            lighting.environment->filtered = all.filtered;
    }

    /// The diffusion work of a frame for the view's objects.
    frame::DiffusionSchedule diffusionSchedule(bool holdsAtlas) const {
        std::vector<frame::DiffusionSchedule::Object> objects(spec.diffusionViews.size());
        for (std::size_t cell = 0; cell < objects.size(); ++cell) {
            const frame::DiffusionKernel& kernel = *spec.diffusionViews[cell].diffusionKernel;
            for (std::size_t level = 0; level < kernel.levels.size(); ++level)
                objects[cell].variancesSquareMetres.push_back(frame::levelReach(kernel, level).mostSquareMetres());
            if (!drawn) continue;
            const frame::DrawnView::DiffusionView& own = drawn->diffusionViews[cell];
            objects[cell].key = own.key;
            objects[cell].tiles = &own.uvAtlas->tiles;
            objects[cell].seen = own.seen;
        }
        if (!drawn) return {nullptr, std::move(objects), holdsAtlas};
        // The callback is looked up at execution.
        const auto objectDiffused = [own = drawn] {
            if (own->objectDiffused) own->objectDiffused();
        };
        return {drawn->diffusionMemory, std::move(objects), holdsAtlas, objectDiffused};
    }

    /// Adds diffusion passes for objects, each lit as a separate view. Skips objects whose visible tiles are up to
    /// date.
    TextureHandle addDiffusedLight(const FrameHandles& frame, const ViewSource& view, std::size_t index) {
        const std::string name =
            index == 0 ? "diffused_light_atlas" : fmt::format("diffused_light_atlas ({})", index + 1);
        TextureHandle atlas = graph.persist(name, DiffusionPasses::diffusionAtlas(spec), frame::kDiffusedLightRevision);
        frame::DiffusionSchedule schedule = diffusionSchedule(graph.holds(atlas));
        for (std::size_t cell = 0; cell < spec.diffusionViews.size(); ++cell) {
            if (schedule.leaves(cell)) continue;
            const frame::DrawnView::DiffusionView* const own = drawn ? &drawn->diffusionViews[cell] : nullptr;
            const ViewSource object{view.technique, spec.diffusionViews[cell], own ? &own->drawn : nullptr};
            const ViewWiring wiring(graph, frame, object, numberOfObject(index, cell));
            const DiffusionPasses::Light light = DiffusionPasses::kept(graph, spec, index, cell);
            const bool holdsLight = graph.holds(light.entering) && graph.holds(light.undiffused);
            const DiffusionPasses::Params params{cell, schedule.next(cell, holdsLight)};
            const DiffusionPasses::Inputs inputs{wiring.surfaces, wiring.lighting, atlas, light,
                                                 own ? own->uvAtlas : nullptr};
            atlas = DiffusionPasses::add(graph, spec, params, inputs).diffusionAtlas;
        }
        return atlas;
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
    /// Adds a G-buffer of the surfaces that a forward technique has lit at `depth`. Multisampled depth does not give
    /// the depth at the pixel's centre, so the G-buffer then draws its own.
    frame::GBufferHandles storeSurfaces(TextureHandle depth) {
        GBufferPass::Inputs inputs{surfaces};
        if (spec.samples == 1) inputs.depth = depth;
        return GBufferPass::add(graph, spec, inputs).gbuffer;
    }
    /// Adds light lists for the visible surfaces, if the frame culls lights. `gbuffer` holds the opaque ones; null:
    /// there is no G-buffer yet.
    void addLightLists(TextureHandle depth, TextureHandle opaque, const frame::GBufferHandles* gbuffer) {
        if (!hasLightLists()) return;
        std::optional<LightListsPass::Normals> normals;
        if (spec.culling.normals != culling::NormalTest::Off) {
            assert(gbuffer);
            const frame::StoredNormals stored = frame::storedNormals(spec.settings.layout, spec.channels).value();
            normals = {gbuffer->textures[stored.attachment], stored.encoding};
        }
        const frame::LitDepths depths = litDepths(depth, opaque);
        lighting.lists =
            spec.culling.builder == culling::Builder::Cpu
                ? LightListsPass::add(graph, spec, {depths, normals}, drawn).lists
                : GpuLightListsPass::add(graph, spec, {depths, lighting.view, lighting.constants}, drawn).lists;
    }
};

OpaquePicture opaqueForward(ViewWiring& wiring) {
    const ForwardPass::Inputs inputs{wiring.surfaces, wiring.lighting, {}, {}};
    const ForwardPass::Outputs lit = ForwardPass::add(wiring.graph, wiring.spec, {}, inputs);
    return {lit.radiance, lit.depth};
}

OpaquePicture opaqueForwardPrepass(ViewWiring& wiring) {
    const DepthPrepass::Params params{wiring.hasLightLists() && wiring.spec.samples > 1};
    const DepthPrepass::Outputs drawn = DepthPrepass::add(wiring.graph, wiring.spec, params, {wiring.surfaces});
    wiring.addLightLists(drawn.depth, drawn.shadingDepth.value_or(drawn.depth), nullptr);
    const ForwardPass::Inputs inputs{wiring.surfaces, wiring.lighting, drawn.depth, {}};
    return {ForwardPass::add(wiring.graph, wiring.spec, {}, inputs).radiance, drawn.depth};
}

OpaquePicture opaqueDeferred(ViewWiring& wiring) {
    const frame::GBufferHandles gbuffer = GBufferPass::add(wiring.graph, wiring.spec, {wiring.surfaces}).gbuffer;
    wiring.addLightLists(gbuffer.depth, gbuffer.depth, &gbuffer);
    const DeferredLightingPass::Outputs lit =
        DeferredLightingPass::add(wiring.graph, wiring.spec, {}, {gbuffer, wiring.lighting}, wiring.drawn);
    return {lit.radiance, gbuffer.depth, gbuffer};
}

OpaquePicture opaqueDeferredVolumes(ViewWiring& wiring) {
    const frame::GBufferHandles gbuffer = GBufferPass::add(wiring.graph, wiring.spec, {wiring.surfaces}).gbuffer;
    const DeferredLightingPass::Params params{.visitsLights = false};
    const TextureHandle unlit =
        DeferredLightingPass::add(wiring.graph, wiring.spec, params, {gbuffer, wiring.lighting}, wiring.drawn).radiance;
    if (!LightVolumesPass::isNeeded(wiring.spec)) return {unlit, gbuffer.depth, gbuffer};
    const LightVolumesPass::Inputs inputs{gbuffer, wiring.lighting, unlit};
    return {LightVolumesPass::add(wiring.graph, wiring.spec, inputs).radiance, gbuffer.depth, gbuffer};
}

/// A technique, and how it draws opaque surfaces.
struct Row {
    TechniqueInfo info;
    OpaquePicture (*addOpaque)(ViewWiring& wiring);
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

/// The image that a view shows, and the depth of opaque surfaces.
struct Shown {
    TextureHandle radiance;
    TextureHandle depth;
};

/// Adds the lit image, including transparent surfaces.
Shown addLitPicture(Technique technique, std::size_t view, ViewWiring& wiring, const AfterOpaque& after) {
    OpaquePicture opaque = kRows[std::size_t(technique)].addOpaque(wiring);
    if (wiring.backdrop) {
        const BackdropPass::Inputs inputs{wiring.surfaces.view, *wiring.backdrop, opaque.depth, opaque.radiance};
        opaque.radiance = BackdropPass::add(wiring.graph, wiring.spec, inputs).radiance;
    }
    // Add passes here that read the opaque image and draw beneath transparent surfaces.
    if (after.readsSurfaces && !opaque.gbuffer) opaque.gbuffer = wiring.storeSurfaces(opaque.depth);
    if (after.add) opaque.radiance = after.add(wiring.graph, view, wiring.spec, opaque);
    TextureHandle seenDepth = opaque.depth;
    if (wiring.seenLights) {
        const SeenLightsPass::Inputs inputs{wiring.surfaces.view, *wiring.seenLights, wiring.seenPictures, opaque.depth,
                                            opaque.radiance};
        const SeenLightsPass::Outputs seen = SeenLightsPass::add(wiring.graph, wiring.spec, inputs);
        opaque.radiance = seen.radiance;
        seenDepth = seen.seenDepth;
    }
    if (!wiring.blends()) return {opaque.radiance, opaque.depth};
    const ForwardPass::Params params{ForwardPass::Surfaces::Transparent};
    ForwardPass::Inputs inputs{wiring.surfaces, wiring.lighting, seenDepth, opaque.radiance, {}, {}};
    if (wiring.passingLobes) inputs.lighting.lobes.table = wiring.passingLobes;
    if (wiring.spec.showsBehindGlass)
        inputs.behind = BehindGlassPass::add(wiring.graph, wiring.spec, {opaque.radiance, seenDepth}).behind;
    if (wiring.spec.drawsFarSides)
        inputs.farSides = FarSidesPass::add(wiring.graph, wiring.spec, {wiring.surfaces}).farSides;
    return {ForwardPass::add(wiring.graph, wiring.spec, params, inputs).radiance, opaque.depth};
}

/// Adds the passes of debug views that replace the lit image; none for other views.
std::optional<Shown> addDebugView(Technique technique, ViewWiring& wiring) {
    const frame::DebugView view = wiring.spec.settings.view;
    if (view == frame::DebugView::Ids) {
        const IdsPass::Outputs drawn = IdsPass::add(wiring.graph, wiring.spec, {wiring.surfaces});
        return Shown{drawn.ids, drawn.depth};
    }
    if (view == frame::DebugView::Overdraw) {
        OverdrawPass::Inputs inputs{wiring.surfaces, {}};
        if (infoOf(technique).geometry == Geometry::DepthFirst)
            inputs.depth = DepthPrepass::add(wiring.graph, wiring.spec, {}, {wiring.surfaces}).depth;
        const OverdrawPass::Outputs drawn = OverdrawPass::add(wiring.graph, wiring.spec, inputs);
        return Shown{drawn.overdraw, drawn.depth};
    }
    if (view == frame::DebugView::ShadowAtlas) {
        const ShadowAtlasPass::Inputs inputs{wiring.lighting.shadowAtlas, wiring.drawn};
        const ShadowAtlasPass::Outputs drawn = ShadowAtlasPass::add(wiring.graph, wiring.spec, inputs);
        return Shown{drawn.radiance, drawn.depth};
    }
    if (const std::optional<frame::StoredComponents> shown = frame::storedComponents(view)) {
        const frame::GBufferHandles gbuffer = GBufferPass::add(wiring.graph, wiring.spec, {wiring.surfaces}).gbuffer;
        return Shown{StoredChannelPass::add(wiring.graph, wiring.spec, {*shown}, {gbuffer}).radiance, gbuffer.depth};
    }
    return {};
}

DeclaredView declareView(graph::Graph& graph, const FrameHandles& frame, const ViewSource& source, std::size_t index,
                         const AfterOpaque& after) {
    const frame::FrameSpec& spec = source.spec;
    ViewWiring wiring(graph, frame, source, index);
    std::optional<Shown> shown = addDebugView(source.technique, wiring);
    if (!shown) shown = addLitPicture(source.technique, index, wiring, after);
    DeclaredView view;
    view.radiance = wiring.resolve(shown->radiance, ResolvePass::Kind::Radiance);
    view.depth = shown->depth;
    view.display = DisplayPass::add(graph, spec, {view.radiance}).display;
    view.lists = wiring.lighting.lists;
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

std::vector<DeclaredView> declareFrame(graph::Graph& graph, std::span<const ViewSource> views,
                                       const AfterOpaque& after) {
    const FrameHandles frame = declareShared(graph, views);
    std::vector<DeclaredView> declared;
    for (std::size_t i = 0; i < views.size(); ++i) declared.push_back(declareView(graph, frame, views[i], i, after));
    return declared;
}

} // namespace tessera::engine
