#include "passes/DepthPrepass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// What the largest of nearest and negated farthest depth starts from.
constexpr glm::vec4 kNoSurface{0.0f, -2.0f, 0.0f, 0.0f};

} // namespace

shader::ProgramDesc DepthPrepass::program(const frame::FrameSpec& spec, const Params& params) {
    return frame::frameProgram(spec, "depth_prepass", "passes/geometry.vert", "passes/depth_prepass.frag",
                               {{"DEPTH_ONLY", "1"}, {"SHADING_DEPTH", params.shadingDepth ? "1" : "0"}});
}

DepthPrepass::Outputs DepthPrepass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params,
                                        const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "depth_prepass",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
            if (params.shadingDepth)
                out.shadingDepth = pass.create("shading_depth", spec.renderTarget(graph::Format::Rg32Float));
        },
        [resources, program = program(spec, params)](const Outputs& out, const graph::PassContext& context) {
            gpu::Attachments targets{{}, &context.texture(out.depth)};
            if (out.shadingDepth) targets.colors.push_back(&context.texture(*out.shadingDepth));
            gpu::bindFramebuffer(resources->framebuffers.get(targets));
            gpu::clearDepth(0.0f);
            if (out.shadingDepth) gpu::clearColor(0, kNoSurface);
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
