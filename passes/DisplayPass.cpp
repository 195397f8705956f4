#include "passes/DisplayPass.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/display.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

shared::DisplayConstants displayConstants(const frame::FrameSettings& settings) {
    shared::DisplayConstants constants{};
    constants.exposure.x = std::exp2(settings.exposureEV);
    constants.scales.x = float(frame::countScaleLog2(settings.view));
    return constants;
}

} // namespace

shader::ProgramDesc DisplayPass::program(const frame::FrameSpec& spec) {
    const frame::DisplayMapping mapping = frame::displayMapping(spec.settings.view, spec.settings.layout);
    return shader::screenProgram("display", "passes/display.frag",
                                 {{"DISPLAY_MAPPING", std::to_string(unsigned(mapping))},
                                  {"TONE_MAP", fmt::format("{}u", unsigned(spec.settings.toneMap))}});
}

DisplayPass::Outputs DisplayPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "display",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            pass.expect(inputs.radiance, spec.texture(graph::Format::Rgba32Float));
            out.radiance = pass.read(inputs.radiance);
            out.display = pass.create("display", spec.texture(graph::Format::Rgba8Unorm));
        },
        [constants = displayConstants(spec.settings)](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::setState({});
            gpu::useProgram(context.program());
            context.constants(UNIFORM_PASS, constants);
            gpu::bindTexture(TEXTURE_UNIT_RADIANCE, context.texture(out.radiance));
            gpu::drawFullscreenTriangle();
        });
}

} // namespace tessera::passes
