#include "passes/GBufferPass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc GBufferPass::program(const frame::FrameSpec& spec) {
    frame::Defines defines = spec.gbufferDefines();
    defines.emplace_back("DEPTH_ONLY", "0");
    return frame::frameProgram(spec, "gbuffer", "passes/geometry.vert", "passes/gbuffer.frag", defines);
}

GBufferPass::Outputs GBufferPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    const bool hasDepth = inputs.depth.has_value();
    return graph.addPass<Outputs>(
        "gbuffer",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            out.read.surfaces = inputs.surfaces.read(pass);
            for (const frame::GBufferTexture& texture : spec.gbufferTextures())
                out.gbuffer.textures.push_back(pass.create("gbuffer." + texture.name, spec.texture(texture.format)));
            const graph::TextureDesc depth = spec.texture(graph::Format::Depth32Float);
            if (hasDepth) pass.expect(*inputs.depth, depth);
            out.gbuffer.depth = hasDepth ? pass.read(*inputs.depth, graph::Access::DepthTest)
                                         : pass.create("depth", depth, graph::Access::DepthAttachment);
        },
        [hasDepth](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            // Channels of uncovered pixels are never read: depth 0 marks them.
            if (!hasDepth) gpu::clearDepth(0.0f);
            gpu::useProgram(context.program());
            gpu::PipelineState state;
            state.depthTest = hasDepth ? gpu::DepthTest::Equal : gpu::DepthTest::GreaterEqual;
            state.depthWrite = !hasDepth;
            out.read.surfaces.drawOpaqueInParts(context, state);
        });
}

} // namespace tessera::passes
