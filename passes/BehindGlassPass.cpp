#include "passes/BehindGlassPass.h"

#include <string>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// A step that makes one texture from another, of the same program for every texel.
struct BehindStep {
    graph::TextureHandle source, made;
};

BehindStep addBehindStep(graph::Graph& graph, const char* name, const shader::ProgramDesc& program,
                         graph::TextureHandle source, const graph::TextureDesc& sourceDesc,
                         const graph::TextureDesc& madeDesc) {
    return graph.addPass<BehindStep>(
        name,
        [&](graph::PassBuilder& pass, BehindStep& step) {
            pass.program(program);
            pass.expect(source, sourceDesc);
            step.source = pass.read(source);
            step.made = pass.create(name, madeDesc);
        },
        [](const BehindStep& step, const graph::PassContext& context) {
            context.bindTargets();
            gpu::setState({});
            gpu::useProgram(context.program());
            gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(step.source));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace

shader::ProgramDesc BehindGlassPass::pictureProgram(const frame::FrameSpec& spec) {
    return shader::screenProgram("behind_glass", "passes/behind_glass.frag",
                                 {{"SAMPLES", std::to_string(spec.samples)}});
}

shader::ProgramDesc BehindGlassPass::levelsProgram() {
    return shader::screenProgram("behind_glass_levels", "passes/behind_glass_levels.frag");
}

BehindGlassPass::Outputs BehindGlassPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    constexpr graph::Format kFormat = graph::Format::Rgba32Float;
    Outputs out;
    out.behind.picture = addBehindStep(graph, "behind_glass", pictureProgram(spec), inputs.radiance,
                                       spec.renderTarget(kFormat), spec.texture(kFormat))
                             .made;
    if (spec.blursBehindGlass)
        out.behind.levels = addBehindStep(graph, "behind_glass_levels", levelsProgram(), out.behind.picture,
                                          spec.texture(kFormat), spec.behindLevels())
                                .made;
    return out;
}

} // namespace tessera::passes
