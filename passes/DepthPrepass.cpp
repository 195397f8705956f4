#include "passes/DepthPrepass.h"

#include "renderer/gpu/Commands.h"

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
                                        const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "depth_prepass",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, params));
            out.read.surfaces = inputs.surfaces.read(pass);
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
            if (params.shadingDepth)
                out.shadingDepth = pass.create("shading_depth", spec.renderTarget(graph::Format::Rg32Float));
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearDepth(0.0f);
            if (out.shadingDepth) gpu::clearColor(0, kNoSurface);
            gpu::useProgram(context.program());
            gpu::PipelineState state;
            // Of two surfaces at one depth the later drawn wins, here as in every other pass.
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            out.read.surfaces.draw(context, frame::SurfaceHandles::Kind::Opaque, state);
        });
}

} // namespace tessera::passes
