#include "passes/SeenLightsPass.h"

#include <string>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

std::vector<shader::ProgramDesc> SeenLightsPass::programs(const frame::FrameSpec& spec) {
    return {shader::screenProgram("copy_depth", "passes/copy_depth.frag", {{"SAMPLES", std::to_string(spec.samples)}}),
            frame::frameProgram(spec, "seen_lights", "passes/seen_lights.vert", "passes/seen_lights.frag",
                                {{"SEEN_PICTURES", spec.showsLightPictures ? "1" : "0"}})};
}

SeenLightsPass::Outputs SeenLightsPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    return graph.addPass<Outputs>(
        "seen_lights",
        [&](graph::PassBuilder& pass, Outputs& out) {
            for (const shader::ProgramDesc& program : programs(spec)) pass.program(program);
            out.view = inputs.view.read(pass);
            out.lights = pass.read(inputs.lights, graph::Access::TexelRead);
            if (inputs.pictures) out.pictures = pass.read(*inputs.pictures, graph::Access::TexelRead);
            pass.expect(inputs.depth, spec.renderTarget(graph::Format::Depth32Float));
            out.depth = pass.read(inputs.depth);
            pass.expect(inputs.radiance, spec.renderTarget(graph::Format::Rgba32Float));
            out.radiance = pass.write(inputs.radiance);
            out.seenDepth = pass.create("seen_depth", spec.renderTarget(graph::Format::Depth32Float),
                                        graph::Access::DepthAttachment);
        },
        [lights = int(spec.seenLights)](const Outputs& out, const graph::PassContext& context) {
            context.bindTargets();
            gpu::PipelineState state;
            state.depthTest = gpu::DepthTest::Always;
            state.depthWrite = true;
            state.colorWrite = false;
            gpu::setState(state);
            gpu::useProgram(context.program(0));
            gpu::bindTexture(TEXTURE_UNIT_DEPTH, context.texture(out.depth));
            gpu::drawFullscreenTriangle();

            state.depthTest = gpu::DepthTest::GreaterEqual;
            state.colorWrite = true;
            gpu::setState(state);
            gpu::useProgram(context.program(1));
            out.view.bind(context);
            gpu::bindTexelBuffer(TEXTURE_UNIT_SEEN_LIGHTS,
                                 context.buffer(out.lights).texels(graph::Format::Rgba32Float));
            if (out.pictures) frame::bindLightPictures(context, *out.pictures);
            constexpr int kCorners = 6; // of two triangles
            gpu::drawInBands([&] { gpu::drawVertices(kCorners, lights); });
        });
}

} // namespace tessera::passes
