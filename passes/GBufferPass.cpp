#include "passes/GBufferPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc GBufferPass::program(const frame::FrameSpec& spec) {
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    defines.emplace_back("DEPTH_ONLY", "0");
    return frame::frameProgram(spec, "gbuffer", "passes/geometry.vert", "passes/gbuffer.frag", defines);
}

GBufferPass::Outputs GBufferPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                      const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "gbuffer",
        [&](graph::PassBuilder& pass, Outputs& out) {
            for (const frame::GBufferTexture& texture : spec.gbufferTextures())
                out.textures.push_back(pass.create("gbuffer." + texture.name, spec.texture(texture.format)));
            out.depth = pass.create("depth", spec.texture(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [resources, program = program(spec)](const Outputs& out, const graph::PassContext& context) {
            gpu::Attachments attachments;
            for (const graph::TextureHandle texture : out.textures)
                attachments.colors.push_back(&context.texture(texture));
            attachments.depth = &context.texture(out.depth);
            gpu::bindFramebuffer(resources->framebuffers.get(attachments));
            // Channels of uncovered pixels are never read: depth 0 says that nothing is there.
            gpu::clearDepth(0.0f);
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            gpu::drawInBands([&] { resources->scene.draw(resources->scene.opaque(), state); }, gpu::BandCost::Geometry);
        });
}

} // namespace tessera::passes
