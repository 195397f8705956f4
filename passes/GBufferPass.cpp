#include "passes/GBufferPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc GBufferPass::program(const frame::FrameSpec& spec) {
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    defines.emplace_back("DEPTH_ONLY", "0");
    return frame::frameProgram(spec, "gbuffer", "passes/geometry.vert", "passes/gbuffer.frag", defines);
}

GBufferPass::Outputs GBufferPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "gbuffer",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            out.read.surfaces = inputs.surfaces.read(pass);
            for (const frame::GBufferTexture& texture : spec.gbufferTextures())
                out.gbuffer.textures.push_back(pass.create("gbuffer." + texture.name, spec.texture(texture.format)));
            out.gbuffer.depth =
                pass.create("depth", spec.texture(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            // Channels of uncovered pixels are never read: depth 0 says that nothing is there.
            gpu::clearDepth(0.0f);
            gpu::useProgram(context.program());
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            gpu::drawInBands([&] { out.read.surfaces.draw(context, frame::SurfaceHandles::Kind::Opaque, state); },
                             gpu::BandCost::Geometry);
        });
}

} // namespace tessera::passes
