#include "passes/LightListsPass.h"

#include <cassert>
#include <new>

#include "base/Error.h"
#include "passes/ListRoom.h"
#include "renderer/gpu/Texture.h"

namespace tessera::passes {

namespace {

culling::DepthPicture download(const gpu::Texture& texture, std::vector<float>& memory) {
    const graph::TextureDesc& desc = texture.desc();
    const bool isRange = desc.format == graph::Format::Rg32Float;
    memory.resize(std::size_t(desc.width) * std::size_t(desc.height) * (isRange ? 2 : 1));
    texture.downloadInto(0, std::as_writable_bytes(std::span(memory)));
    return {memory, isRange};
}

/// Uploads values that shaders read as a storage block.
template <typename Value>
void upload(const graph::PassContext& context, graph::BufferHandle handle, const char* what,
            const std::vector<Value>& values) {
    makeBlockRoom(context, handle, what, values.size() * sizeof(Value)).upload(values);
}

/// Downloads the normals of a texture into `memory`.
culling::NormalPicture downloadNormals(const gpu::Texture& texture, const culling::NormalEncoding& encoding,
                                       const shared::ViewConstants& view, std::vector<std::uint32_t>& memory) {
    const graph::TextureDesc& desc = texture.desc();
    memory.resize(std::size_t(desc.width) * std::size_t(desc.height) *
                  std::size_t(graph::formatInfo(desc.format).bytes) / sizeof(std::uint32_t));
    texture.downloadInto(0, std::as_writable_bytes(std::span(memory)));
    const glm::mat3 lightingFromCulling(glm::normalize(glm::dvec3(view.rayDxLS)),
                                        glm::normalize(glm::dvec3(view.rayDyLS)), glm::dvec3(view.forwardLS));
    return {memory, memory.size() / (std::size_t(desc.width) * std::size_t(desc.height)), encoding,
            glm::transpose(lightingFromCulling)};
}

void build(const frame::FrameSpec& spec, const frame::DrawnView& drawn, const LightListsPass::Outputs& out,
           const graph::PassContext& context) {
    frame::LightListMemory& memory = *drawn.listMemory;
    const culling::DepthPicture opaque = download(context.texture(out.read.depths.opaque), memory.depth);
    culling::DepthPicture transparent;
    const bool hasTransparent = out.read.depths.transparent.has_value();
    if (hasTransparent) transparent = download(context.texture(*out.read.depths.transparent), memory.transparentDepth);
    const auto readNormals = [&] {
        return downloadNormals(context.texture(out.read.normals->texture), out.read.normals->encoding,
                               drawn.prepared.camera.constants, memory.normals);
    };
    try {
        const culling::LightLists& lists =
            memory.builder.build({drawn.prepared.constants(), drawn.prepared.cullLights, spec.culling.method, opaque,
                                  hasTransparent ? &transparent : nullptr, spec.culling.normals, readNormals});
        requireReadable("light tiles", LIGHT_TILE_TEXELS * lists.tiles.size());
        upload(context, out.lists.tiles, "light tiles", lists.tiles);
        upload(context, out.lists.cells, "light cells", lists.cells);
        makeTexelRoom(context, out.lists.entries, "light entries", lists.entries.size(), graph::Format::R32Uint)
            .upload(lists.entries);
    } catch (const std::bad_alloc&) {
        throw InputError("light lists do not fit into this machine's memory: larger tiles, another culling method or "
                         "fewer lights need less");
    }
}

} // namespace

LightListsPass::Outputs LightListsPass::add(graph::Graph& graph, const frame::FrameSpec& spec, const Inputs& inputs,
                                            const frame::DrawnView* drawn) {
    return graph.addPass<Outputs>(
        "light_lists",
        [&](graph::PassBuilder& pass, Outputs& out) {
            out.read.depths = inputs.depths.read(pass, spec, graph::Access::Download);
            assert(inputs.normals.has_value() == (spec.culling.normals != culling::NormalTest::Off));
            if (inputs.normals)
                out.read.normals = {pass.read(inputs.normals->texture, graph::Access::Download),
                                    inputs.normals->encoding};
            out.lists.tiles = pass.create("light_tiles", kGrowing, graph::Access::Upload);
            out.lists.cells = pass.create(frame::kLightCellsName, kGrowing, graph::Access::Upload);
            out.lists.entries = pass.create(frame::kLightEntriesName, kGrowing, graph::Access::Upload);
        },
        [drawn, spec](const Outputs& out, const graph::PassContext& context) { build(spec, *drawn, out, context); });
}

} // namespace tessera::passes
