#include "passes/UploadPass.h"

#include <algorithm>

#include "passes/ListRoom.h"
#include "renderer/frame/LightBuffers.h"

namespace tessera::passes {

using graph::Access;

namespace {

template <typename Value>
void upload(const graph::PassContext& context, graph::BufferHandle handle, const std::vector<Value>& values) {
    context.allocate(handle, values.size() * sizeof(Value)).upload(values);
}

/// A buffer of so many values; the number changes with the view's visible draws.
template <typename Value>
graph::BufferDesc growing(std::size_t count) {
    return {std::max<std::size_t>(count, 1) * sizeof(Value), true};
}

} // namespace

UploadViewPass::Outputs UploadViewPass::add(graph::Graph& graph, const frame::DrawnView* drawn) {
    return graph.addPass<Outputs>(
        "view",
        [](graph::PassBuilder& pass, Outputs& out) {
            out.constants = pass.create("view", {sizeof(shared::ViewConstants)}, Access::Upload);
            out.rows = pass.create("draw_rows", kGrowing, Access::Upload);
            out.commands = pass.create("draw_commands", kGrowing, Access::Upload);
        },
        [drawn](const Outputs& out, const graph::PassContext& context) {
            context.buffer(out.constants).uploadValue(drawn->prepared.camera.constants);
            upload(context, out.rows, drawn->draws.rows);
            upload(context, out.commands, drawn->scene->commandsOf(drawn->draws));
        });
}

UploadLightsPass::Outputs UploadLightsPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                                const frame::DrawnView* drawn) {
    return graph.addPass<Outputs>(
        "lights",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.constants = pass.create("lighting", {sizeof(shared::LightingConstants)}, Access::Upload);
            out.lights = pass.create("lights", growing<shared::LightTexels>(spec.lights), Access::Upload);
            if (spec.features.lightShapes())
                out.shapes =
                    pass.create("light_shapes", growing<shared::LightShapeTexels>(spec.lights), Access::Upload);
        },
        [drawn](const Outputs& out, const graph::PassContext& context) {
            const frame::PreparedView& view = drawn->prepared;
            context.buffer(out.constants).uploadValue(view.lighting);
            context.buffer(out.lights).upload(view.lights.texels);
            if (out.shapes) context.buffer(*out.shapes).upload(view.lights.shapes);
        });
}

} // namespace tessera::passes
