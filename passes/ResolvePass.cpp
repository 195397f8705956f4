#include "passes/ResolvePass.h"

#include <string>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

struct KindInfo {
    ResolvePass::Kind kind;
    const char* pass;     ///< its name in the graph
    const char* resolved; ///< name of its output
    graph::Format format;
};

constexpr KindInfo kKinds[] = {
    {ResolvePass::Kind::Radiance, "resolve", "resolved", graph::Format::Rgba32Float},
    {ResolvePass::Kind::Depths, "depth_range", "depth_range", graph::Format::Rg32Float},
    {ResolvePass::Kind::TransparentDepths, "transparent_depth_range", "transparent_depth_range",
     graph::Format::Rg32Float},
};

const KindInfo& infoOf(const ResolvePass::Params& params) {
    return kKinds[std::size_t(params.kind)];
}

} // namespace

shader::ProgramDesc ResolvePass::program(const frame::FrameSpec& spec, const Params& params) {
    const bool depths = params.kind != Kind::Radiance;
    return shader::screenProgram(depths ? "resolve_depths" : "resolve", "passes/resolve.frag",
                                 {{"SAMPLES", std::to_string(spec.samples)}, {"RESOLVES_DEPTHS", depths ? "1" : "0"}});
}

ResolvePass::Outputs ResolvePass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Params& params,
                                      const Inputs& inputs) {
    const KindInfo& info = infoOf(params);
    return graph.addPass<Outputs>(
        info.pass,
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, params));
            pass.expect(inputs.samples, spec.renderTarget(info.format));
            out.read.samples = pass.read(inputs.samples);
            out.resolved = pass.create(info.resolved, spec.texture(info.format));
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::setState({});
            gpu::useProgram(context.program());
            gpu::bindTexture(TEXTURE_UNIT_SAMPLES, context.texture(out.read.samples));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
