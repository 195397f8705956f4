#include "passes/BehindGlassPass.h"

#include <optional>

#include "renderer/frame/FrameDefines.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

struct PictureStep {
    graph::TextureHandle radiance, picture;
    std::optional<graph::TextureHandle> depth, centreDepth; ///< with several samples per pixel
};

struct LevelsStep {
    graph::TextureHandle picture, levels;
};

/// Draws every texel of the targets from the bound textures.
void drawTexels(const graph::PassContext& context) {
    context.bindTargets();
    gpu::setState({});
    gpu::useProgram(context.program());
    gpu::drawFullscreenTriangle();
}

} // namespace

shader::ProgramDesc BehindGlassPass::pictureProgram(const frame::FrameSpec& spec) {
    return shader::screenProgram("behind_glass", "passes/behind_glass.frag", frame::sampleDefines(spec));
}

shader::ProgramDesc BehindGlassPass::levelsProgram() {
    return shader::screenProgram("behind_glass_levels", "passes/behind_glass_levels.frag");
}

BehindGlassPass::Outputs BehindGlassPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    constexpr graph::Format kFormat = graph::Format::Rgba32Float;
    const auto picture = graph.addPass<PictureStep>(
        "behind_glass",
        [&](graph::PassBuilder& pass, PictureStep& step) {
            pass.program(pictureProgram(spec));
            pass.expect(inputs.radiance, spec.renderTarget(kFormat));
            step.radiance = pass.read(inputs.radiance);
            step.picture = pass.create("behind_glass", spec.texture(kFormat));
            if (spec.samples == 1) return;
            pass.expect(inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
            step.depth = pass.read(inputs.depth);
            step.centreDepth = pass.create("behind_glass_depth", spec.texture(graph::Format::R32Float));
        },
        [](const PictureStep& step, const graph::PassContext& context) {
            gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(step.radiance));
            if (step.depth) gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(*step.depth));
            drawTexels(context);
        });
    Outputs out{{picture.picture, {}, picture.centreDepth}};
    if (spec.blursBehindGlass)
        out.behind.levels = graph
                                .addPass<LevelsStep>(
                                    "behind_glass_levels",
                                    [&](graph::PassBuilder& pass, LevelsStep& step) {
                                        pass.program(levelsProgram());
                                        pass.expect(picture.picture, spec.texture(kFormat));
                                        step.picture = pass.read(picture.picture);
                                        step.levels = pass.create("behind_glass_levels", spec.behindLevels());
                                    },
                                    [](const LevelsStep& step, const graph::PassContext& context) {
                                        gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(step.picture));
                                        drawTexels(context);
                                    })
                                .levels;
    return out;
}

} // namespace tessera::passes
