#include "passes/LightVolumesPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/light_volumes.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

using frame::Feature;

bool LightVolumesPass::isNeeded(const frame::FrameSpec& spec) {
    const bool anyLight = spec.features[Feature::DirectionalLights] || spec.features[Feature::PointLights] ||
                          spec.features[Feature::SpotLights];
    return frame::sumsOverLights(spec.settings.view) && anyLight && spec.features.litModels();
}

shader::ProgramDesc LightVolumesPass::program(const frame::FrameSpec& spec) {
    frame::Defines defines = frame::channelDefines(spec.settings.layout, spec.channels);
    defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    return frame::frameProgram(spec, "light_volumes", "passes/light_volumes.vert", "passes/light_volumes.frag",
                               defines);
}

LightVolumesPass::Outputs LightVolumesPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                                const frame::FrameResources* resources) {
    const int vertices = spec.features[Feature::SpotLights] ? LIGHT_VOLUME_CONE_VERTICES : LIGHT_VOLUME_SPHERE_VERTICES;
    return graph.addPass<Outputs>(
        "light_volumes",
        [&](graph::PassBuilder& pass, Outputs& out) {
            const std::vector<frame::GBufferTexture> textures = spec.gbufferTextures();
            for (std::size_t i = 0; i < inputs.textures.size(); ++i) {
                pass.expect(inputs.textures[i], spec.texture(textures[i].format));
                out.textures.push_back(pass.read(inputs.textures[i]));
            }
            pass.expect(inputs.depth, spec.texture(graph::Format::Depth32Float));
            out.depth = pass.read(inputs.depth, graph::Access::DepthTest);
            pass.expect(inputs.radiance, spec.texture(graph::Format::Rgba32Float));
            out.radiance = pass.write(inputs.radiance);
        },
        [resources, vertices, program = program(spec)](const Outputs& out, const graph::PassContext& context) {
            gpu::bindFramebuffer(
                resources->framebuffers.get({{&context.texture(out.radiance)}, &context.texture(out.depth)}));
            gpu::PipelineState state;
            // Passes where the surface is nearer than the volume's back; never where nothing was drawn, at depth 0.
            state.depthTest = gpu::DepthTest::Less;
            state.depthClamp = true; // volumes may reach past the near and the far plane
            state.cullFace = gpu::CullFace::Front;
            state.blend = gpu::Blend::Additive;
            gpu::setState(state);
            gpu::useProgram(resources->programs.get(program));
            gpu::bindUniformBuffer(UNIFORM_FRAME, resources->frameConstants);
            resources->lights.bind();
            resources->scene.bindMaterialTable();
            for (std::size_t i = 0; i < out.textures.size(); ++i) {
                gpu::bindTexture(TEXTURE_UNIT_GBUFFER + std::uint32_t(i), context.texture(out.textures[i]));
            }
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.depth));
            gpu::drawInBands([&] { gpu::drawVertices(vertices, int(resources->constants.lights.x)); });
        });
}

} // namespace tessera::passes
