#include "passes/LightVolumesPass.h"

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/light_volumes.h"

namespace tessera::passes {

using frame::Feature;

bool LightVolumesPass::isNeeded(const frame::FrameSpec& spec) {
    return frame::sumsOverLights(spec.settings.view) && spec.features.anyLights() && spec.features.litModels();
}

shader::ProgramDesc LightVolumesPass::program(const frame::FrameSpec& spec) {
    frame::Defines defines = spec.gbufferDefines();
    defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    return frame::frameProgram(spec, "light_volumes", "passes/light_volumes.vert", "passes/light_volumes.frag",
                               defines);
}

LightVolumesPass::Outputs LightVolumesPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                const Inputs& inputs) {
    const int vertices = spec.features.coneLights() ? LIGHT_VOLUME_CONE_VERTICES : LIGHT_VOLUME_SPHERE_VERTICES;
    return graph.addPass<Outputs>(
        "light_volumes",
        [&](graph::PassBuilder& pass, Outputs& out) {
            pass.program(program(spec));
            out.gbuffer = inputs.gbuffer.read(pass, spec, graph::Access::DepthTest);
            out.lighting = inputs.lighting.read(pass);
            pass.expect(inputs.radiance, spec.texture(graph::Format::Rgba32Float));
            out.radiance = pass.write(inputs.radiance);
        },
        [vertices, lights = int(spec.lights)](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::PipelineState state;
            // Passes where the surface is nearer than the volume's back; never where nothing was drawn, at depth 0.
            state.depthTest = gpu::DepthTest::Less;
            state.depthClamp = true; // volumes may extend beyond the near and far plane
            state.cullFace = gpu::CullFace::Front;
            state.blend = gpu::Blend::Additive;
            gpu::setState(state);
            gpu::useProgram(context.program());
            out.lighting.bind(context);
            out.gbuffer.bind(context);
            gpu::drawInBands([&] { gpu::drawVertices(vertices, lights); });
        });
}

} // namespace tessera::passes
