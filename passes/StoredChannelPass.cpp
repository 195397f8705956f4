#include "passes/StoredChannelPass.h"

#include <string>

#include "renderer/gpu/Commands.h"

namespace tessera::passes {

shader::ProgramDesc StoredChannelPass::program(const frame::FrameSpec& spec, const Params& params) {
    const std::string name = "GBUFFER_" + std::string(frame::channelTable()[std::size_t(params.shown.channel)].define);
    const bool packed = spec.settings.layout[params.shown.channel] != frame::Encoding::Exact;
    frame::Defines defines = spec.gbufferDefines();
    defines.emplace_back("STORED_CHANNEL", name);
    defines.emplace_back("STORED_PACKED", packed ? "1" : "0");
    if (packed) defines.emplace_back("STORED_WIDTHS", name + "_WIDTHS");
    defines.emplace_back("SHOWS_FOURTH", params.shown.fourth ? "1" : "0");
    return frame::frameProgram(spec, "stored_channel", "passes/fullscreen.vert", "passes/stored_channel.frag", defines);
}

StoredChannelPass::Outputs StoredChannelPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                  const Params& params, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "stored_channel",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, params));
            out.read.gbuffer = inputs.gbuffer.read(pass, spec);
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float));
        },
        [](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::setState({});
            gpu::useProgram(context.program());
            out.read.gbuffer.bind(context);
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
