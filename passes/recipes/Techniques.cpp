#include "passes/recipes/Techniques.h"

#include "passes/DeferredLightingPass.h"
#include "passes/DepthPrepass.h"
#include "passes/DisplayPass.h"
#include "passes/ForwardPass.h"
#include "passes/GBufferPass.h"

namespace tessera::recipes {

namespace {

using namespace passes;
using graph::TextureHandle;

constexpr TechniqueInfo kTechniques[] = {
    {Technique::Forward, "forward", "shaded as it is rasterised", "every fragment loops over all lights; the baseline",
     false},
    {Technique::ForwardPrepass, "forward_prepass", "depth first, then equal depth only",
     "each visible pixel once, all lights", false},
    {Technique::Deferred, "deferred", "G-buffer", "full screen, each covered pixel once, all lights", true},
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
    TextureHandle depthPrepass() {
        frame.programs.push_back(DepthPrepass::program(spec));
        return DepthPrepass::add(frame.graph, spec, resources).depth;
    }
    GBufferPass::Outputs gbuffer() {
        frame.programs.push_back(GBufferPass::program(spec));
        return GBufferPass::add(frame.graph, spec, resources);
    }
    TextureHandle deferredLighting(const GBufferPass::Outputs& gbuffer) {
        frame.programs.push_back(DeferredLightingPass::program(spec));
        return DeferredLightingPass::add(frame.graph, spec, {gbuffer.channels, gbuffer.depth}, resources).radiance;
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
    const TextureHandle depth = recipe.depthPrepass();
    return {recipe.forward({}, {depth, {}}).radiance, depth};
}

OpaquePicture opaqueDeferred(Recipe& recipe) {
    const GBufferPass::Outputs gbuffer = recipe.gbuffer();
    return {recipe.deferredLighting(gbuffer), gbuffer.depth};
}

OpaquePicture opaquePicture(Technique technique, Recipe& recipe) {
    switch (technique) {
    case Technique::Forward:
        return opaqueForward(recipe);
    case Technique::ForwardPrepass:
        return opaqueForwardPrepass(recipe);
    case Technique::Deferred:
        break;
    }
    return opaqueDeferred(recipe);
}

} // namespace

std::span<const TechniqueInfo> techniqueTable() {
    return kTechniques;
}

DeclaredFrame declareFrame(Technique technique, const frame::FrameSpec& spec, const frame::FrameResources* resources) {
    DeclaredFrame frame;
    Recipe recipe{frame, spec, resources};
    const OpaquePicture opaque = opaquePicture(technique, recipe);
    frame.radiance = opaque.radiance;
    if (spec.features[frame::Feature::Blend]) {
        const ForwardPass::Params params{ForwardPass::Surfaces::Transparent};
        frame.radiance = recipe.forward(params, {opaque.depth, opaque.radiance}).radiance;
    }
    frame.display = recipe.display(frame.radiance);
    frame.graph.output(frame.radiance);
    frame.graph.output(frame.display);
    return frame;
}

} // namespace tessera::recipes
