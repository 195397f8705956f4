#include "passes/DeferredLightingPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc DeferredLightingPass::program(const frame::FrameSpec& spec, const Params& params) {
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    if (params.visitsLights) {
        frame::addCursorDefines(spec, false, defines);
    } else {
        defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    }
    return frame::frameProgram(spec, "deferred_lighting", "passes/fullscreen.vert", "passes/deferred_lighting.frag",
                               defines);
}

DeferredLightingPass::Outputs DeferredLightingPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                        const Params& params, const Inputs& inputs,
                                                        const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "deferred_lighting",
        [&](graph::PassBuilder& pass, Outputs& out) {
            for (std::size_t i = 0; i < inputs.channels.size(); ++i) {
                pass.expect(inputs.channels[i], spec.texture(spec.settings.layout.format(spec.channels[i])));
                out.read.channels.push_back(pass.read(inputs.channels[i]));
            }
            pass.expect(inputs.depth, spec.texture(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth);
            if (inputs.lists) out.read.lists = frame::readLightLists(pass, *inputs.lists);
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float));
        },
        [resources, program = program(spec, params)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{&context.texture(out.radiance)}, nullptr}));
            gpu::setState({});
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            resources->lights.bind();
            if (out.read.lists) resources->lightLists.bind();
            for (std::size_t i = 0; i < out.read.channels.size(); ++i) {
                gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), context.texture(out.read.channels[i]));
            }
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.read.depth));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
