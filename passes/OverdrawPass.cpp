#include "passes/OverdrawPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc OverdrawPass::program(const frame::FrameSpec& spec, Surfaces surfaces) {
    const bool blended = surfaces == Surfaces::Transparent;
    return frame::frameProgram(spec, blended ? "transparent_overdraw" : "overdraw", "passes/geometry.vert",
                               "passes/overdraw.frag", {{"DEPTH_ONLY", "1"}, {"BLENDED", blended ? "1" : "0"}});
}

OverdrawPass::Outputs OverdrawPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                        const frame::FrameResources* resources) {
    const bool prepassed = inputs.depth.has_value();
    return graph.addPass<Outputs>(
        "overdraw",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.overdraw = pass.create("overdraw", spec.renderTarget(graph::Format::Rgba32Float));
            const graph::TextureDesc depth = spec.renderTarget(graph::Format::Depth32Float);
            if (prepassed) pass.expect(*inputs.depth, depth);
            out.depth = prepassed ? pass.read(*inputs.depth, graph::Access::DepthTest)
                                  : pass.create("depth", depth, graph::Access::DepthAttachment);
        },
        [resources, prepassed, opaque = program(spec, Surfaces::Opaque),
         transparent = program(spec, Surfaces::Transparent),
         blends = spec.features[frame::Feature::Blend]](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(
                resources->framebuffers.get({{&context.texture(out.overdraw)}, &context.texture(out.depth)}));
            gpu::clearColor(0, glm::vec4(0.0f));
            if (!prepassed) gpu::clearDepth(0.0f);
            gpu::useProgram(resources->programs.get(opaque));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            gpu::PipelineState state;
            state.depthTest = prepassed ? gpu::DepthTest::Equal : gpu::DepthTest::GreaterEqual;
            state.depthWrite = !prepassed;
            state.blend = gpu::Blend::AdditiveCovering;
            resources->scene.draw(resources->scene.opaque(), state);
            if (!blends) return;
            gpu::useProgram(resources->programs.get(transparent));
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = false;
            resources->scene.draw(resources->scene.transparent(), state);
        });
}

} // namespace tessera::passes
