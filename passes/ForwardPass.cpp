#include "passes/ForwardPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

gpu::PipelineState pipelineState(const ForwardPass::Params& params, bool prepassed, frame::DebugView view) {
    gpu::PipelineState state;
    if (params.surfaces == ForwardPass::Surfaces::Transparent) {
        state.depthTest = gpu::DepthTest::GreaterEqual;
        // Light counts of layers add up, regardless of the layers' opacity.
        state.blend = view == frame::DebugView::Lights ? gpu::Blend::AdditiveCovering : gpu::Blend::AlphaStraight;
    } else {
        state.depthTest = prepassed ? gpu::DepthTest::Equal : gpu::DepthTest::GreaterEqual;
        state.depthWrite = !prepassed;
    }
    return state;
}

/// Blend mode of transmissive surfaces: lit ones transmit per channel. Debug views draw them like other surfaces.
std::optional<gpu::Blend> transmitting(const ForwardPass::Params& params, frame::DebugView view) {
    const bool isLit = params.surfaces == ForwardPass::Surfaces::Transparent && view == frame::DebugView::Final;
    return isLit ? std::optional(gpu::Blend::Transmitting) : std::nullopt;
}

} // namespace

shader::ProgramDesc ForwardPass::program(const frame::FrameSpec& spec, const Params& params) {
    const bool blended = params.surfaces == Surfaces::Transparent;
    frame::Defines defines{{"DEPTH_ONLY", "0"}, {"BLENDED", blended ? "1" : "0"}};
    frame::addCursorDefines(spec, blended, defines);
    return frame::frameProgram(spec, blended ? "transparent" : "forward", "passes/geometry.vert", "passes/forward.frag",
                               defines);
}

ForwardPass::Outputs ForwardPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params,
                                      const Inputs& inputs) {
    const bool transparent = params.surfaces == Surfaces::Transparent;
    const bool prepassed = inputs.depth.has_value();
    return graph.addPass<Outputs>(
        transparent ? "transparent" : "forward",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, params));
            out.surfaces = inputs.surfaces.read(pass);
            out.lighting = inputs.lighting.read(pass);
            if (prepassed) {
                pass.expect(*inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
                out.depth = pass.read(*inputs.depth, graph::Access::DepthTest);
            } else {
                out.depth = pass.create("depth", spec.renderTarget(graph::Format::Depth32Float),
                                        graph::Access::DepthAttachment);
            }
            if (inputs.behind) out.behind = inputs.behind->read(pass, spec);
            if (inputs.farSides) {
                pass.expect(*inputs.farSides, spec.texture(graph::Format::Rgba32Float));
                out.farSides = pass.read(*inputs.farSides);
            }
            if (inputs.radiance) pass.expect(*inputs.radiance, spec.renderTarget(graph::Format::Rgba32Float));
            out.radiance = inputs.radiance ? pass.write(*inputs.radiance)
                                           : pass.create("radiance", spec.renderTarget(graph::Format::Rgba32Float));
        },
        [params, prepassed, view = spec.settings.view, background = spec.background,
         keepsPicture = inputs.radiance.has_value()](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            if (!keepsPicture) gpu::clearColor(0, background);
            if (!prepassed) gpu::clearDepth(0.0f);
            gpu::useProgram(context.program());
            out.lighting.bind(context);
            if (out.behind) {
                out.behind->bind(context);
                gpu::bindTexture(TEXTURE_UNIT_BEHIND_DEPTH, context.texture(out.behind->depth.value_or(out.depth)));
            }
            if (out.farSides) gpu::bindTexture(TEXTURE_UNIT_FAR_SIDES, context.texture(*out.farSides));
            gpu::drawInBands([&] {
                out.surfaces.draw(context, params.surfaces, pipelineState(params, prepassed, view),
                                  transmitting(params, view));
            });
        });
}

} // namespace tessera::passes
