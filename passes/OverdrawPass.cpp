#include "passes/OverdrawPass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc OverdrawPass::program(const frame::FrameSpec& spec, Surfaces surfaces) {
    const bool blended = surfaces == Surfaces::Transparent;
    return frame::frameProgram(spec, blended ? "transparent_overdraw" : "overdraw", "passes/geometry.vert",
                               "passes/overdraw.frag", {{"DEPTH_ONLY", "1"}, {"BLENDED", blended ? "1" : "0"}});
}

OverdrawPass::Outputs OverdrawPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    const bool prepassed = inputs.depth.has_value();
    const bool blends = spec.features[frame::Feature::Blend];
    return graph.addPass<Outputs>(
        "overdraw",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, Surfaces::Opaque));
            out.surfaces = inputs.surfaces.read(pass);
            if (blends) pass.program(program(spec, Surfaces::Transparent));
            out.overdraw = pass.create("overdraw", spec.renderTarget(graph::Format::Rgba32Float));
            const graph::TextureDesc depth = spec.renderTarget(graph::Format::Depth32Float);
            if (prepassed) pass.expect(*inputs.depth, depth);
            out.depth = prepassed ? pass.read(*inputs.depth, graph::Access::DepthTest)
                                  : pass.create("depth", depth, graph::Access::DepthAttachment);
        },
        [prepassed, blends](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f));
            if (!prepassed) gpu::clearDepth(0.0f);
            gpu::useProgram(context.program(0));
            gpu::PipelineState state;
            state.depthTest = prepassed ? gpu::DepthTest::Equal : gpu::DepthTest::GreaterEqual;
            state.depthWrite = !prepassed;
            state.blend = gpu::Blend::AdditiveCovering;
            out.surfaces.draw(context, Surfaces::Opaque, state);
            if (!blends) return;
            gpu::useProgram(context.program(1));
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = false;
            out.surfaces.draw(context, Surfaces::Transparent, state);
        });
}

} // namespace tessera::passes
