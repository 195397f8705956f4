#include "passes/DepthPrepass.h"

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

namespace {

/// Initial value of the maximum of nearest depth and negated farthest depth.
constexpr glm::vec4 kNoSurface{0.0f, -2.0f, 0.0f, 0.0f};

} // namespace

std::vector<shader::ProgramDesc> DepthPrepass::programs(const frame::FrameSpec& spec, const Params& params) {
    return frame::depthPrograms(spec, "depth_prepass", "passes/depth_prepass.frag", true,
                                {{"SHADING_DEPTH", params.shadingDepth ? "1" : "0"}});
}

DepthPrepass::Outputs DepthPrepass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params,
                                        const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "depth_prepass",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.read.surfaces = inputs.surfaces.readDepth(pass, programs(spec, params));
            out.depth =
                pass.create("depth", spec.renderTarget(graph::Format::Depth32Float), graph::Access::DepthAttachment);
            if (params.shadingDepth)
                out.shadingDepth = pass.create("shading_depth", spec.renderTarget(graph::Format::Rg32Float));
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearDepth(0.0f);
            if (out.shadingDepth) gpu::clearColor(0, kNoSurface);
            gpu::PipelineState state;
            // Of two surfaces at one depth the later drawn wins, here as in every other pass.
            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.depthWrite = true;
            out.read.surfaces.drawDepth(context, frame::SurfaceHandles::Kind::Opaque, state);
        });
}

} // namespace tessera::passes
