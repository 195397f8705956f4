#include "passes/DepthPrepass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc DepthPrepass::program(const frame::FrameSpec& spec) {
    return frame::frameProgram(spec, "depth_prepass", "passes/geometry.vert", "passes/depth_prepass.frag",
                               {{"DEPTH_ONLY", "1"}});
}

DepthPrepass::Outputs DepthPrepass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                        const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "depth_prepass",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.depth = pass.create("depth", spec.texture(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [resources, program = program(spec)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{}, &context.texture(out.depth)}));
            gpu::clearDepth(0.0f);
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            gpu::PipelineState state;
            // Of two surfaces at one depth the later drawn wins, here as in every other pass.
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            resources->scene.draw(resources->scene.opaque(), state);
        });
}

} // namespace tessera::passes
