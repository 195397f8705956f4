#include "passes/TransparentDepthPass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

std::vector<shader::ProgramDesc> TransparentDepthPass::programs(const frame::FrameSpec& spec) {
    return frame::depthPrograms(spec, "transparent_depth", "passes/transparent_depth.frag", false, {});
}

TransparentDepthPass::Outputs TransparentDepthPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                        const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "transparent_depth",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.read.surfaces = inputs.surfaces.readDepth(pass, programs(spec));
            pass.expect(inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth, graph::Access::DepthTest);
            out.transparentDepth = pass.create("transparent_depth", spec.renderTarget(graph::Format::Rg32Float));
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f, -2.0f, 0.0f, 0.0f));
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.blend = gpu::Blend::Max;
            out.read.surfaces.drawDepth(context, frame::SurfaceHandles::Kind::Transparent, state);
        });
}

} // namespace tessera::passes
