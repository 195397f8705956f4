#include "passes/DisplayPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc DisplayPass::program() {
    shader::ProgramDesc program;
    program.name = "display";
    program.vertex = "passes/fullscreen.vert";
    program.fragment = "passes/display.frag";
    return program;
}

DisplayPass::Outputs DisplayPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                      const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "display",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.expect(inputs.radiance, spec.texture(graph::Format::Rgba32Float));
            out.radiance = pass.read(inputs.radiance);
            out.display = pass.create("display", spec.texture(graph::Format::Rgba8Unorm));
        },
        [resources](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{&context.texture(out.display)}, nullptr}));
            gpu::setState({});
            gpu::useProgram(resources->programs.get(program()));
            gpu::bindUniformBuffer(UNIFORM_DISPLAY, resources->displayConstants);
            gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(out.radiance));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
