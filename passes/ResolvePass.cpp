#include "passes/ResolvePass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc ResolvePass::program(const frame::FrameSpec& spec) {
    shader::ProgramDesc program;
    program.name = "resolve";
    program.vertex = "passes/fullscreen.vert";
    program.fragment = "passes/resolve.frag";
    program.defines = {{"SAMPLES", std::to_string(spec.samples)}};
    return program;
}

ResolvePass::Outputs ResolvePass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                      const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "resolve",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.expect(inputs.radiance, spec.renderTarget(graph::Format::Rgba32Float));
            out.read.radiance = pass.read(inputs.radiance);
            out.resolved = pass.create("resolved", spec.texture(graph::Format::Rgba32Float));
        },
        [resources, program = program(spec)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{&context.texture(out.resolved)}, nullptr}));
            gpu::setState({});
            gpu::useProgram(resources->programs.get(program));
            gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(out.read.radiance));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
