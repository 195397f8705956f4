#include "passes/UploadPass.h"

#include <algorithm>

#include "passes/ListRoom.h"
#include "renderer/frame/LightBuffer.h"

namespace tessera::passes {

using graph::Access;

namespace {

template <typename Value>
void upload(const graph::PassContext& context, graph::BufferHandle handle, const std::vector<Value>& values) {
    context.allocate(handle, values.size() * sizeof(Value)).upload(values);
}

} // namespace

UploadViewPass::Outputs UploadViewPass::add(graph::Graph& graph, const frame::FrameSpec& spec,
                                            const frame::DrawnView* drawn) {
    return graph.addPass<Outputs>(
        "view",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.constants = pass.create("view", {sizeof(shared::ViewConstants)}, Access::Upload);
            out.rows = pass.create("draw_rows", kGrowing, Access::Upload);
            out.commands = pass.create("draw_commands", kGrowing, Access::Upload);
            if (spec.hook) out.hook = pass.create("hook", {sizeof(shared::HookConstants)}, Access::Upload);
        },
        [drawn](const Outputs& out, const graph::PassContext& context) {
            context.buffer(out.constants).uploadValue(drawn->prepared.camera.constants);
            if (out.hook) context.buffer(*out.hook).uploadValue(drawn->prepared.hook);
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
            out.lights = pass.create("lights",
                                     {frame::lightBytes(spec.features, std::max<std::size_t>(spec.lights, 1)) +
                                          spec.shadowFaces * sizeof(shared::ShadowFaceTexels),
                                      true},
                                     Access::Upload);
            if (spec.environment)
                out.environment = pass.create("environment", {sizeof(shared::EnvironmentConstants)}, Access::Upload);
            if (spec.tracesShadows())
                out.casterTree = pass.create("caster_tree", {sizeof(shared::CasterTreeConstants)}, Access::Upload);
            if (spec.seenLights > 0)
                out.seenLights = pass.create("seen_lights", {spec.seenLights * sizeof(shared::SeenLightTexels), true},
                                             Access::Upload);
        },
        [drawn](const Outputs& out, const graph::PassContext& context) {
            const frame::PreparedView& view = drawn->prepared;
            if (out.casterTree)
                context.buffer(*out.casterTree)
                    .uploadValue(frame::casterTreeConstants(drawn->scene->casters()->space, view.camera));
            if (out.seenLights) context.buffer(*out.seenLights).upload(view.seenLights);
            if (out.environment) context.buffer(*out.environment).uploadValue(view.environment);
            context.buffer(out.constants).uploadValue(view.lighting);
            std::vector<glm::vec4> texels = frame::texelsOf(view.lights, view.spec.features);
            for (const shared::ShadowFaceTexels& face : view.shadowFaces)
                texels.insert(texels.end(), {face.right, face.up, face.forward, face.place});
            context.buffer(out.lights).upload(texels);
        });
}

} // namespace tessera::passes
