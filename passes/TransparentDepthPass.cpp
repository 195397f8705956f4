#include "passes/TransparentDepthPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc TransparentDepthPass::program(const frame::FrameSpec& spec) {
    return frame::frameProgram(spec, "transparent_depth", "passes/geometry.vert", "passes/transparent_depth.frag",
                               {{"DEPTH_ONLY", "1"}});
}

TransparentDepthPass::Outputs TransparentDepthPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                        const Inputs& inputs, const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "transparent_depth",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.expect(inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth, graph::Access::DepthTest);
            out.transparentDepth = pass.create("transparent_depth", spec.renderTarget(graph::Format::Rg32Float));
        },
        [resources, program = program(spec)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get(
                {{&context.texture(out.transparentDepth)}, &context.texture(out.read.depth)}));
            gpu::clearColor(0, glm::vec4(0.0f, -2.0f, 0.0f, 0.0f));
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.blend = gpu::Blend::Max;
            resources->scene.draw(resources->scene.transparent(), state);
        });
}

} // namespace tessera::passes
