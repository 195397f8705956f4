#include "passes/ShadowMapsPass.h"

#include <fmt/format.h>

#include "passes/ListRoom.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

using graph::Access;

namespace {

/// The draws of all faces to be drawn.
struct Draws {
    graph::BufferHandle rows, commands;
};

Draws addUpload(graph::Graph& graph, const frame::DrawnView* drawn) {
    return graph.addPass<Draws>(
        "shadow_draws",
        [](graph::PassBuilder& pass, Draws& out) {
            out.rows = pass.create("shadow_draw_rows", kGrowing, Access::Upload);
            out.commands = pass.create("shadow_draw_commands", kGrowing, Access::Upload);
        },
        [drawn](const Draws& out, const graph::PassContext& context) {
            const frame::ShadowDraws& draws = drawn->shadowMemory->draws();
            context.allocate(out.rows, draws.rows.size() * sizeof draws.rows[0]).upload(draws.rows);
            context.allocate(out.commands, draws.commands.size() * sizeof draws.commands[0]).upload(draws.commands);
        });
}

/// Limits the bias in a cascade to the width of a texel: a caster steeper than that hides the surface below within the
/// texel, and a larger bias would leak light. Other faces have nonlinear depth, for which no single limit holds.
float mostSlopeBias(const shared::ViewConstants& face) {
    const bool isParallel = face.forwardLS.w != 0.0f;
    return isParallel ? -face.rayFromPixel.x / face.depthKey.y : 0.0f;
}

} // namespace

std::vector<shader::ProgramDesc> ShadowMapsPass::programs(const frame::FrameSpec& spec) {
    frame::FrameSpec ofMaps = spec;
    ofMaps.samples = 1;
    ofMaps.diffusionKernel.reset(); // lights see an object's geometry, not its UV atlas
    return frame::depthPrograms(ofMaps, "shadow_maps", "passes/depth_prepass.frag", true, {{"SHADING_DEPTH", "0"}});
}

ShadowMapsPass::Outputs ShadowMapsPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs) {
    // The contents of the atlas are tracked per face, not by a revision of the whole.
    constexpr std::uint64_t kRevision = 1;
    const frame::DrawnView* const drawn = inputs.drawn;
    const std::size_t number = drawn == nullptr ? inputs.view : drawn->shadowMemory->number();
    const std::string name = number == 0 ? "shadow_atlas" : fmt::format("shadow_atlas ({})", number + 1);
    const graph::TextureDesc desc{graph::Format::Depth32Float, spec.shadowAtlasTexels.x, spec.shadowAtlasTexels.y};
    graph::TextureHandle atlas = graph.persist(name, desc, kRevision);
    if (drawn != nullptr &&
        !drawn->shadowMemory->begin(drawn->prepared.shadowMaps, *drawn->scene, graph.holds(atlas), spec.settings.prune))
        return {atlas};

    struct Data {
        frame::SurfaceHandles surfaces;
        graph::TextureHandle atlas;
    };
    const Draws draws = addUpload(graph, drawn);
    const frame::SurfaceHandles surfaces{drawn, inputs.scene, {}, draws.rows, draws.commands, {}, {}};
    return {graph
                .addPass<Data>(
                    "shadow_maps",
                    [&](graph::PassBuilder& pass, Data& out) {
                        out.surfaces = surfaces.readDepth(pass, programs(spec));
                        out.atlas = pass.write(atlas, Access::DepthAttachment);
                    },
                    [](const Data& out, const graph::PassContext& context) {
                        const frame::DrawnView& drawnView = *out.surfaces.drawn;
                        context.bindTargets();
                        gpu::PipelineState state;
                        state.depthTest = gpu::DepthTest::Greater;
                        state.depthWrite = true;
                        state.bothSides = true;
                        // GL biases by the larger change of depth along a row or a column of texels, which is at least
                        // half of their sum.
                        state.slopeBias = -1.0f;
                        for (const frame::ShadowDraws::Face& face : drawnView.shadowMemory->draws().faces) {
                            gpu::setViewport(face.corner.x, face.corner.y, face.side, face.side);
                            gpu::setScissor({face.corner.x, face.corner.y, face.side, face.side});
                            gpu::clearDepth(0.0f);
                            if (face.batches.empty()) continue;
                            context.constants(UNIFORM_VIEW, face.view);
                            state.mostSlopeBias = mostSlopeBias(face.view);
                            out.surfaces.drawDepth(context, face.batches, state);
                        }
                        drawnView.shadowMemory->end();
                    })
                .atlas};
}

} // namespace tessera::passes
