#include "passes/StoredChannelPass.h"

#include <cassert>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// 32-bit words of an integer format; 0 for formats that are read as numbers.
int storedWords(graph::Format format) {
    const graph::FormatInfo& info = graph::formatInfo(format);
    if (!info.integer) return 0;
    assert((format == graph::Format::R32Uint || format == graph::Format::Rg32Uint) &&
           "say how the words of another integer format come apart in stored_channel.frag");
    return info.bytes / 4;
}

} // namespace

shader::ProgramDesc StoredChannelPass::program(const frame::FrameSpec& spec, const Params& params) {
    shader::ProgramDesc program;
    program.name = "stored_channel";
    program.vertex = "passes/fullscreen.vert";
    program.fragment = "passes/stored_channel.frag";
    program.defines = {{"STORED_WORDS", std::to_string(storedWords(spec.settings.layout.format(params.shown.channel)))},
                       {"SHOWS_FOURTH", params.shown.fourth ? "1" : "0"}};
    return program;
}

StoredChannelPass::Outputs StoredChannelPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                  const Params& params, const Inputs& inputs,
                                                  const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "stored_channel",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.expect(inputs.channel, spec.texture(spec.settings.layout.format(params.shown.channel)));
            out.read.channel = pass.read(inputs.channel);
            pass.expect(inputs.depth, spec.texture(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth);
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float));
        },
        [resources, program = program(spec, params)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(resources->framebuffers.get({{&context.texture(out.radiance)}, nullptr}));
            gpu::clearColor(0, glm::vec4(0.0f));
            gpu::setState({});
            gpu::useProgram(resources->programs.get(program));
            gpu::bindTexture(TEXTURE_UNIT_GBUFFER, context.texture(out.read.channel));
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.read.depth));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
