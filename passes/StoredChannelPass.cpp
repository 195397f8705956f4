#include "passes/StoredChannelPass.h"

#include <string>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

shader::ProgramDesc StoredChannelPass::program(const frame::FrameSpec& spec, const Params& params) {
    const std::string name = "GBUFFER_" + std::string(frame::channelTable()[std::size_t(params.shown.channel)].define);
    const bool packed = spec.settings.layout[params.shown.channel] != frame::Encoding::Exact;
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    defines.emplace_back("STORED_CHANNEL", name);
    defines.emplace_back("STORED_PACKED", packed ? "1" : "0");
    if (packed) defines.emplace_back("STORED_WIDTHS", name + "_WIDTHS");
    defines.emplace_back("SHOWS_FOURTH", params.shown.fourth ? "1" : "0");
    return frame::frameProgram(spec, "stored_channel", "passes/fullscreen.vert", "passes/stored_channel.frag", defines);
}

StoredChannelPass::Outputs StoredChannelPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                  const Params& params, const Inputs& inputs,
                                                  const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "stored_channel",
        [&](graph::PassBuilder& pass, Outputs& out) {
            const auto textures = frame::gbufferTextures(spec.settings.layout, spec.channels);
            for (std::size_t i = 0; i < inputs.textures.size(); ++i) {
                pass.expect(inputs.textures[i], spec.texture(textures[i].format));
                out.read.textures.push_back(pass.read(inputs.textures[i]));
            }
            pass.expect(inputs.depth, spec.texture(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth);
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float));
        },
        [resources, program = program(spec, params)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{&context.texture(out.radiance)}, nullptr}));
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::setState({});
            gpu::useProgram(resources->programs.get(program));
            for (std::size_t i = 0; i < out.read.textures.size(); ++i)
                gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), context.texture(out.read.textures[i]));
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.read.depth));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
