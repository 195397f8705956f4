#include "passes/DeferredLightingPass.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

constexpr std::uint32_t kGroupSidePixels = 8;

bool inCompute(const frame::FrameSpec& spec) {
    return spec.lightOn == frame::LightingStage::Compute;
}

void drawPicture(const frame::FrameResources& resources, const gpu::Texture& radiance) {
    gpu::bindFramebuffer(resources.framebuffers.get({{&radiance}, nullptr}));
    gpu::clearColor(0, resources.background);
    gpu::setState({});
    gpu::drawFullscreenTriangle();
}

void dispatchPicture(const gpu::Texture& radiance) {
    const auto groups = [](int pixels) { return (std::uint32_t(pixels) + kGroupSidePixels - 1) / kGroupSidePixels; };
    gpu::bindImage(IMAGE_UNIT_RADIANCE, radiance, gpu::ImageAccess::Write);
    gpu::dispatch(groups(radiance.desc().width), groups(radiance.desc().height));
}

} // namespace

shader::ProgramDesc DeferredLightingPass::program(const frame::FrameSpec& spec, const Params& params) {
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    if (params.visitsLights) {
        frame::addCursorDefines(spec, false, defines);
    } else {
        defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    }
    if (!inCompute(spec)) {
        return frame::frameProgram(spec, "deferred_lighting", "passes/fullscreen.vert", "passes/deferred_lighting.frag",
                                   defines);
    }
    defines.emplace_back("LIGHTING_GROUP_SIDE", std::to_string(kGroupSidePixels));
    shader::ProgramDesc program = frame::frameProgram(spec, "deferred_lighting", "", "", defines);
    program.compute = "passes/deferred_lighting.comp";
    return program;
}

DeferredLightingPass::Outputs DeferredLightingPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                        const Params& params, const Inputs& inputs,
                                                        const frame::FrameResources* resources) {
    return graph.addPass<Outputs>(
        "deferred_lighting",
        [&](graph::PassBuilder& pass, Outputs& out) {
            const std::vector<frame::GBufferTexture> textures = spec.gbufferTextures();
            for (std::size_t i = 0; i < inputs.textures.size(); ++i) {
                pass.expect(inputs.textures[i], spec.texture(textures[i].format));
                out.read.textures.push_back(pass.read(inputs.textures[i]));
            }
            pass.expect(inputs.depth, spec.texture(graph::Format::Depth32Float));
            out.read.depth = pass.read(inputs.depth);
            if (inputs.lists) out.read.lists = frame::readLightLists(pass, *inputs.lists);
            out.radiance = pass.create("radiance", spec.texture(graph::Format::Rgba32Float),
                                       inCompute(spec) ? graph::Access::ImageWrite : graph::Access::ColorAttachment);
        },
        [resources, compute = inCompute(spec), program = program(spec, params)](const Outputs& out,
                                                                                const graph::PassContext& context) {
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            resources->lights.bind();
            resources->scene.bindMaterialTable();
            if (out.read.lists) resources->lightLists.bind();
            for (std::size_t i = 0; i < out.read.textures.size(); ++i) {
                gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), context.texture(out.read.textures[i]));
            }
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.read.depth));
            if (compute)
                dispatchPicture(context.texture(out.radiance));
            else
                drawPicture(*resources, context.texture(out.radiance));
        });
}

} // namespace tessera::passes
