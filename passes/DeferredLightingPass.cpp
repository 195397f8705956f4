#include "passes/DeferredLightingPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

constexpr std::uint32_t kGroupSidePixels = 8;

bool inCompute(const frame::FrameSpec& spec) {
    return spec.lightOn == frame::LightingStage::Compute;
}

void clearBetween(const glm::ivec2& low, const glm::ivec2& high, const glm::vec4& background) {
    if (low.x >= high.x || low.y >= high.y) return;
    gpu::setScissor({low.x, low.y, high.x - low.x, high.y - low.y});
    gpu::clearColor(0, background);
}

/// Lights the pixels that may show a surface and clears those below, above and beside them.
void drawPicture(const graph::PassContext& context, const glm::ivec2& size, const frame::PixelArea& lit,
                 const glm::vec4& background) {
    context.bindTargets();
    clearBetween({0, 0}, {size.x, lit.low.y}, background);
    clearBetween({0, lit.high.y}, size, background);
    clearBetween({0, lit.low.y}, {lit.low.x, lit.high.y}, background);
    clearBetween({lit.high.x, lit.low.y}, {size.x, lit.high.y}, background);
    if (lit.empty()) return;
    gpu::setState({});
    gpu::setScissor({lit.low.x, lit.low.y, lit.high.x - lit.low.x, lit.high.y - lit.low.y});
    gpu::drawFullscreenTriangle();
}

void dispatchPicture(const gpu::Texture& radiance) {
    const auto groups = [](int pixels) { return (std::uint32_t(pixels) + kGroupSidePixels - 1) / kGroupSidePixels; };
    gpu::bindImage(IMAGE_UNIT_RADIANCE, radiance, gpu::ImageAccess::Write);
    gpu::dispatch(groups(radiance.desc().width), groups(radiance.desc().height));
}

} // namespace

shader::ProgramDesc DeferredLightingPass::program(const frame::FrameSpec& spec, const Params& params) {
    frame::Defines defines = spec.gbufferDefines();
    if (params.visitsLights) {
        frame::addCursorDefines(spec, false, defines);
    } else {
        defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    }
    defines.emplace_back("LIGHT_TILES_IN_TEXELS", "1");
    constexpr const char* kSource = "passes/deferred_lighting.glsl";
    defines.emplace_back("LIGHTING_IN_COMPUTE", inCompute(spec) ? "1" : "0");
    if (!inCompute(spec) && spec.settings.softwareBackend) defines.emplace_back("FLAT_CONSTANTS", "1");
    if (!inCompute(spec))
        return frame::frameProgram(spec, "deferred_lighting", "passes/fullscreen.vert", kSource, defines);
    defines.emplace_back("LIGHTING_GROUP_SIDE", std::to_string(kGroupSidePixels));
    shader::ProgramDesc program = frame::frameProgram(spec, "deferred_lighting", "", "", defines);
    program.compute = kSource;
    return program;
}

DeferredLightingPass::Outputs DeferredLightingPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                        const Params& params, const Inputs& inputs,
                                                        const frame::DrawnView* drawn) {
    return graph.addPass<Outputs>(
        "deferred_lighting",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec, params));
            out.read = {inputs.gbuffer.read(pass, spec), inputs.lighting.read(pass)};
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float),
                                       inCompute(spec) ? graph::Access::ImageWrite : graph::Access::ColorAttachment);
        },
        [spec, drawn](const Outputs& out, const graph::PassContext& context) {
            gpu::useProgram(context.program());
            out.read.lighting.bind(context);
            out.read.gbuffer.bind(context);
            if (inCompute(spec))
                dispatchPicture(context.texture(out.radiance));
            else
                drawPicture(context, spec.settings.sizePixels, drawn->draws.opaquePixels, spec.background);
        });
}

} // namespace tessera::passes
