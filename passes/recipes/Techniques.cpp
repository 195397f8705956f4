#include "passes/recipes/Techniques.h"

#include <algorithm>

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

namespace tessera::recipes {

namespace {

using namespace passes;
using graph::TextureHandle;

using culling::Method;
constexpr Method kAllLights[] = {Method::None};
constexpr Method kTiled[] = {Method::Tile25d, Method::TileMinmax, Method::None};
constexpr Method kClustered[] = {Method::Cluster, Method::Zbin, Method::None};

constexpr TechniqueInfo kTechniques[] = {
    {Technique::Forward, "forward", "shaded as it is rasterised", "every fragment loops over all lights; the baseline",
     false, kAllLights, true},
    {Technique::ForwardPrepass, "forward_prepass", "depth first, then equal depth only",
     "each visible pixel once, all lights", false, kAllLights, true},
    {Technique::Deferred, "deferred", "G-buffer", "full screen, each covered pixel once, all lights", true, kAllLights},
    {Technique::DeferredVolumes, "deferred_volumes", "G-buffer",
     "one proxy volume a light, depth tested, added by blending", true, kAllLights},
    {Technique::TiledDeferred, "tiled_deferred", "G-buffer", "full screen, each covered pixel once, its tile's lights",
     true, kTiled},
    {Technique::ForwardPlus, "forward_plus", "depth first, then equal depth only",
     "each visible pixel once, its tile's lights", false, kTiled, true},
    {Technique::ClusteredDeferred, "clustered_deferred", "G-buffer",
     "full screen, each covered pixel once, its cluster's lights", true, kClustered},
    {Technique::ClusteredForward, "clustered_forward", "depth first, then equal depth only",
     "each visible pixel once, its cluster's lights", false, kClustered, true},
};

/// Declares passes and notes their programs as it goes.
struct Recipe {
    DeclaredFrame& frame;
    const frame::FrameSpec& spec;
    const frame::FrameResources* resources;

    ForwardPass::Outputs forward(const ForwardPass::Params& params, const ForwardPass::Inputs& inputs) {
        frame.programs.push_back(ForwardPass::program(spec, params));
        return ForwardPass::add(frame.graph, spec, params, inputs, resources);
    }
    bool hasLightLists() const { return spec.culling.method != Method::None; }
    DepthPrepass::Outputs depthPrepass(const DepthPrepass::Params& params) {
        frame.programs.push_back(DepthPrepass::program(spec, params));
        return DepthPrepass::add(frame.graph, spec, params, resources);
    }
    IdsPass::Outputs ids() {
        frame.programs.push_back(IdsPass::program(spec, IdsPass::Surfaces::Opaque));
        if (spec.features[frame::Feature::Blend])
            frame.programs.push_back(IdsPass::program(spec, IdsPass::Surfaces::Transparent));
        return IdsPass::add(frame.graph, spec, resources);
    }
    OverdrawPass::Outputs overdraw(const OverdrawPass::Inputs& inputs) {
        frame.programs.push_back(OverdrawPass::program(spec, OverdrawPass::Surfaces::Opaque));
        if (spec.features[frame::Feature::Blend])
            frame.programs.push_back(OverdrawPass::program(spec, OverdrawPass::Surfaces::Transparent));
        return OverdrawPass::add(frame.graph, spec, inputs, resources);
    }
    GBufferPass::Outputs gbuffer() {
        frame.programs.push_back(GBufferPass::program(spec));
        return GBufferPass::add(frame.graph, spec, resources);
    }
    TextureHandle deferredLighting(const DeferredLightingPass::Params& params, const GBufferPass::Outputs& gbuffer) {
        frame.programs.push_back(DeferredLightingPass::program(spec, params));
        return DeferredLightingPass::add(frame.graph, spec, params, {gbuffer.textures, gbuffer.depth, frame.lists},
                                         resources)
            .radiance;
    }
    TextureHandle lightVolumes(const GBufferPass::Outputs& gbuffer, TextureHandle radiance) {
        if (!LightVolumesPass::isNeeded(spec)) return radiance;
        frame.programs.push_back(LightVolumesPass::program(spec));
        return LightVolumesPass::add(frame.graph, spec, {gbuffer.textures, gbuffer.depth, radiance}, resources)
            .radiance;
    }
    TextureHandle storedChannel(frame::StoredComponents shown, const GBufferPass::Outputs& gbuffer) {
        frame.programs.push_back(StoredChannelPass::program(spec, {shown}));
        return StoredChannelPass::add(frame.graph, spec, {shown}, {gbuffer.textures, gbuffer.depth}, resources)
            .radiance;
    }
    /// One sample a pixel of what was drawn with several.
    TextureHandle resolve(TextureHandle samples, ResolvePass::Kind kind) {
        if (spec.samples == 1) return samples;
        frame.programs.push_back(ResolvePass::program(spec, {kind}));
        return ResolvePass::add(frame.graph, spec, {kind}, {samples}, resources).resolved;
    }
    /// The depths at which what shows is lit: opaque surfaces at `opaque`, transparent ones in front of `depth`.
    frame::LitDepths litDepths(TextureHandle depth, TextureHandle opaque) {
        frame::LitDepths depths{resolve(opaque, ResolvePass::Kind::Depths), {}};
        if (!spec.features[frame::Feature::Blend]) return depths;
        frame.programs.push_back(TransparentDepthPass::program(spec));
        const TextureHandle transparent =
            TransparentDepthPass::add(frame.graph, spec, {depth}, resources).transparentDepth;
        depths.transparent = resolve(transparent, ResolvePass::Kind::TransparentDepths);
        return depths;
    }
    /// Light lists for what shows, where the frame culls lights.
    void lightLists(TextureHandle depth, TextureHandle opaque) {
        if (!hasLightLists()) return;
        const frame::LitDepths depths = litDepths(depth, opaque);
        if (spec.culling.builder == culling::Builder::Cpu) {
            frame.lists = LightListsPass::add(frame.graph, spec, {depths}, resources).lists;
            return;
        }
        for (shader::ProgramDesc& program : GpuLightListsPass::programs(spec))
            frame.programs.push_back(std::move(program));
        frame.lists = GpuLightListsPass::add(frame.graph, spec, {depths}, resources).lists;
    }
    TextureHandle display(TextureHandle radiance) {
        frame.programs.push_back(DisplayPass::program());
        return DisplayPass::add(frame.graph, spec, {radiance}, resources).display;
    }
};

/// What opaque geometry leaves for the passes after it.
struct OpaquePicture {
    TextureHandle radiance;
    TextureHandle depth;
};

OpaquePicture opaqueForward(Recipe& recipe) {
    const ForwardPass::Outputs lit = recipe.forward({}, {});
    return {lit.radiance, lit.depth};
}

OpaquePicture opaqueForwardPrepass(Recipe& recipe) {
    const DepthPrepass::Outputs drawn = recipe.depthPrepass({recipe.hasLightLists() && recipe.spec.samples > 1});
    recipe.lightLists(drawn.depth, drawn.shadingDepth.value_or(drawn.depth));
    return {recipe.forward({}, {drawn.depth, {}, recipe.frame.lists}).radiance, drawn.depth};
}

OpaquePicture opaqueDeferred(Recipe& recipe) {
    const GBufferPass::Outputs gbuffer = recipe.gbuffer();
    recipe.lightLists(gbuffer.depth, gbuffer.depth);
    return {recipe.deferredLighting({}, gbuffer), gbuffer.depth};
}

OpaquePicture opaqueDeferredVolumes(Recipe& recipe) {
    const GBufferPass::Outputs gbuffer = recipe.gbuffer();
    const TextureHandle unlit = recipe.deferredLighting({.visitsLights = false}, gbuffer);
    return {recipe.lightVolumes(gbuffer, unlit), gbuffer.depth};
}

OpaquePicture opaquePicture(Technique technique, Recipe& recipe) {
    switch (technique) {
    case Technique::Forward:
        return opaqueForward(recipe);
    case Technique::ForwardPrepass:
    case Technique::ForwardPlus:
    case Technique::ClusteredForward:
        return opaqueForwardPrepass(recipe);
    case Technique::DeferredVolumes:
        return opaqueDeferredVolumes(recipe);
    case Technique::Deferred:
    case Technique::TiledDeferred:
    case Technique::ClusteredDeferred:
        break;
    }
    return opaqueDeferred(recipe);
}

/// The lit picture, transparent surfaces included, and the depth of opaque ones.
void addLitPicture(Technique technique, Recipe& recipe) {
    DeclaredFrame& frame = recipe.frame;
    const OpaquePicture opaque = opaquePicture(technique, recipe);
    frame.radiance = opaque.radiance;
    frame.depth = opaque.depth;
    if (!recipe.spec.features[tessera::frame::Feature::Blend]) return;
    const ForwardPass::Params params{ForwardPass::Surfaces::Transparent};
    frame.radiance = recipe.forward(params, {opaque.depth, opaque.radiance, frame.lists}).radiance;
}

bool hasPrepass(Technique technique) {
    return technique == Technique::ForwardPrepass || technique == Technique::ForwardPlus ||
           technique == Technique::ClusteredForward;
}

/// What stands in for the lit picture in views that are drawn by passes of their own; false for all others.
bool addView(Technique technique, Recipe& recipe) {
    DeclaredFrame& frame = recipe.frame;
    const frame::View view = recipe.spec.settings.view;
    if (view == frame::View::Ids) {
        const IdsPass::Outputs drawn = recipe.ids();
        frame.radiance = drawn.ids;
        frame.depth = drawn.depth;
    } else if (view == frame::View::Overdraw) {
        OverdrawPass::Inputs inputs;
        if (hasPrepass(technique)) inputs.depth = recipe.depthPrepass({}).depth;
        const OverdrawPass::Outputs drawn = recipe.overdraw(inputs);
        frame.radiance = drawn.overdraw;
        frame.depth = drawn.depth;
    } else if (const std::optional<frame::StoredComponents> shown = frame::storedComponents(view)) {
        const GBufferPass::Outputs gbuffer = recipe.gbuffer();
        frame.radiance = recipe.storedChannel(*shown, gbuffer);
        frame.depth = gbuffer.depth;
    } else {
        return false;
    }
    return true;
}

} // namespace

std::span<const TechniqueInfo> techniqueTable() {
    return kTechniques;
}

const TechniqueInfo& infoOf(Technique technique) {
    return kTechniques[std::size_t(technique)];
}

DeclaredFrame declareFrame(Technique technique, const frame::FrameSpec& spec, const frame::FrameResources* resources) {
    DeclaredFrame frame;
    Recipe recipe{frame, spec, resources};
    if (!addView(technique, recipe)) addLitPicture(technique, recipe);
    frame.radiance = recipe.resolve(frame.radiance, ResolvePass::Kind::Radiance);
    frame.display = recipe.display(frame.radiance);
    frame.graph.output(frame.radiance);
    frame.graph.output(frame.depth);
    if (spec.settings.display) frame.graph.output(frame.display);
    return frame;
}

} // namespace tessera::recipes
