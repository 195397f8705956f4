#include "passes/LightListsPass.h"

#include <new>

#include "renderer/gpu/Texture.h"
#include "scenes/Error.h"

namespace tessera::passes {

namespace {

culling::DepthPicture download(const gpu::Texture& texture, std::vector<float>& memory) {
    const graph::TextureDesc& desc = texture.desc();
    const bool isRange = desc.format == graph::Format::Rg32Float;
    memory.resize(std::size_t(desc.width) * std::size_t(desc.height) * (isRange ? 2 : 1));
    texture.downloadInto(0, std::as_writable_bytes(std::span(memory)));
    return {memory, isRange};
}

void build(const frame::FrameSpec& spec, const frame::FrameResources& resources, const LightListsPass::Inputs& read,
           const graph::PassContext& context) {
    frame::LightListBuffers& lists = resources.lightLists;
    const culling::DepthPicture opaque = download(context.texture(read.depths.opaque), lists.depth);
    culling::DepthPicture transparent;
    if (read.depths.transparent)
        transparent = download(context.texture(*read.depths.transparent), lists.transparentDepth);
    try {
        lists.upload(
            lists.builder.build({resources.constants, spec.settings.sizePixels, resources.cullLights,
                                 spec.culling.method, opaque, read.depths.transparent ? &transparent : nullptr}));
    } catch (const std::bad_alloc&) {
        throw InputError(
            "light lists do not fit into this machine's memory: larger tiles (--tile 64), another --culling "
            "method or fewer lights (--lights N) need less");
    }
}

} // namespace

LightListsPass::Outputs LightListsPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                            const frame::FrameResources* resources) {
    const frame::LightListHandles buffers =
        frame::importLightLists(graph, frame::lightTileCount(spec), resources ? &resources->lightLists : nullptr);
    return graph.addPass<Outputs>(
        "light_lists",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.read.depths = frame::readLitDepths(pass, spec, inputs.depths, graph::Access::Download);
            out.lists.tiles = pass.write(buffers.tiles, graph::Access::Upload);
            out.lists.cells = pass.write(buffers.cells, graph::Access::Upload);
            out.lists.entries = pass.write(buffers.entries, graph::Access::Upload);
        },
        [resources, spec](const Outputs& out, const graph::PassContext& context) {
            build(spec, *resources, out.read, context);
        });
}

} // namespace tessera::passes
