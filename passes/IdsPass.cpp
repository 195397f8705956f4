#include "passes/IdsPass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc IdsPass::program(const frame::FrameSpec& spec, Surfaces surfaces) {
    const bool blended = surfaces == Surfaces::Transparent;
    return frame::frameProgram(spec, blended ? "transparent_ids" : "ids", "passes/geometry.vert", "passes/ids.frag",
                               {{"DEPTH_ONLY", "1"}, {"DRAW_IDS", "1"}, {"BLENDED", blended ? "1" : "0"}});
}

IdsPass::Outputs IdsPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    const bool hasTransparent = spec.features[frame::Feature::Blend];
    const bool blends = hasTransparent && !spec.settings.idsOfNearest;
    const bool covers = hasTransparent && spec.settings.idsOfNearest;
    return graph.addPass<Outputs>(
        "ids",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, Surfaces::Opaque));
            out.read.surfaces = inputs.surfaces.read(pass);
            if (blends) pass.program(program(spec, Surfaces::Transparent));
            out.ids = pass.create("ids", spec.renderTarget(graph::Format::Rgba32Float));
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
        },
        [blends, covers](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::clearDepth(0.0f);
            gpu::useProgram(context.program(0));
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            out.read.surfaces.draw(context, Surfaces::Opaque, state);
            if (covers) out.read.surfaces.draw(context, Surfaces::Transparent, state);
            if (!blends) return;
            gpu::useProgram(context.program(1));
            state.depthWrite = false;
            state.blend = gpu::Blend::AdditiveCovering;
            out.read.surfaces.draw(context, Surfaces::Transparent, state);
        });
}

} // namespace tessera::passes
