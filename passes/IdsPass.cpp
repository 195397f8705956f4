#include "passes/IdsPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc IdsPass::program(const frame::FrameSpec& spec, Surfaces surfaces) {
    const bool blended = surfaces == Surfaces::Transparent;
    return frame::frameProgram(spec, blended ? "transparent_ids" : "ids", "passes/geometry.vert", "passes/ids.frag",
                               {{"DEPTH_ONLY", "1"}, {"DRAW_IDS", "1"}, {"BLENDED", blended ? "1" : "0"}});
}

IdsPass::Outputs IdsPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                              const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "ids",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.ids = pass.create("ids", spec.renderTarget(graph::Format::Rgba32Float));
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [resources, opaque = program(spec, Surfaces::Opaque), transparent = program(spec, Surfaces::Transparent),
         blends = spec.features[frame::Feature::Blend]](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(
                resources->framebuffers.get({{&context.texture(out.ids)}, &context.texture(out.depth)}));
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::clearDepth(0.0f);
            gpu::useProgram(resources->programs.get(opaque));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            resources->scene.draw(resources->scene.opaque(), state);
            if (!blends) return;
            gpu::useProgram(resources->programs.get(transparent));
            state.depthWrite = false;
            state.blend = gpu::Blend::AdditiveCovering;
            resources->scene.draw(resources->scene.transparent(), state);
        });
}

} // namespace tessera::passes
