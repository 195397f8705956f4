#include "passes/FarSidesPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc FarSidesPass::program(const frame::FrameSpec& spec) {
    return frame::frameProgram(spec, "far_sides", "passes/geometry.vert", "passes/far_sides.frag",
                               {{"DEPTH_ONLY", "0"}, {"BLENDED", "0"}});
}

FarSidesPass::Outputs FarSidesPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "far_sides",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            out.surfaces = inputs.surfaces.read(pass);
            out.farSides = pass.create("far_sides", spec.texture(graph::Format::Rgba32Float));
            out.depth =
                pass.create("far_depth", spec.texture(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [areClosed = infoOf(spec.settings.refraction).farSide == frame::RefractionInfo::FarSide::BackFacesOfClosed](
            const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::clearDepth(0.0f);
            gpu::useProgram(context.program());
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            state.farSides = true;
            state.farSidesOfClosed = areClosed;
            gpu::drawInBands([&] { out.surfaces.draw(context, frame::SurfaceHandles::Kind::Transparent, state); });
        });
}

} // namespace tessera::passes
