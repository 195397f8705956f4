#include "passes/BackdropPass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc BackdropPass::program(const frame::FrameSpec& spec) {
    const bool isBlurred = spec.settings.environment.backdrop == frame::Backdrop::Blurred;
    return frame::frameProgram(spec, "backdrop", "passes/fullscreen.vert", "passes/backdrop.frag",
                               {{"BACKDROP_BLURRED", isBlurred ? "1" : "0"}});
}

BackdropPass::Outputs BackdropPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "backdrop",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            out.view = inputs.view.read(pass);
            out.environment = inputs.environment.read(pass);
            pass.expect(inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
            out.depth = pass.read(inputs.depth, graph::Access::DepthTest);
            pass.expect(inputs.radiance, spec.renderTarget(graph::Format::Rgba32Float));
            out.radiance = pass.write(inputs.radiance);
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::Equal; // the triangle lies at depth 0
            gpu::setState(state);
            gpu::useProgram(context.program());
            out.view.bind(context);
            out.environment.bind(context);
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
