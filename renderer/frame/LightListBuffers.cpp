#include "renderer/frame/LightListBuffers.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

LightListHandles importLightLists(graph::Graph& graph, std::size_t tiles, const LightListBuffers* held) {
    const auto bytes = [](const GrowingTexelBuffer& buffer) { return buffer.buffer().bytes(); };
    const std::size_t tileBytes = tiles * sizeof(shared::LightTile);
    return {graph.import("light_tiles", graph::BufferDesc{held ? bytes(held->tiles) : tileBytes}),
            graph.import(kLightCellsName, graph::BufferDesc{held ? bytes(held->cells) : 0}),
            graph.import(kLightEntriesName, graph::BufferDesc{held ? bytes(held->entries) : 0}),
            {}};
}

graph::BufferHandle importLightReach(graph::Graph& graph, std::size_t lights, const LightListBuffers* held) {
    return graph.import("light_reach",
                        graph::BufferDesc{held ? held->reach.buffer().bytes() : lights * sizeof(glm::uvec2)});
}

graph::TextureDesc opaqueDepths(const FrameSpec& spec) {
    return spec.texture(spec.samples > 1 ? graph::Format::Rg32Float : graph::Format::Depth32Float);
}

LitDepths readLitDepths(graph::PassBuilder& pass, const FrameSpec& spec, const LitDepths& depths,
                        graph::Access access) {
    pass.expect(depths.opaque, opaqueDepths(spec));
    LitDepths read{pass.read(depths.opaque, access), {}};
    if (!depths.transparent) return read;
    pass.expect(*depths.transparent, spec.texture(graph::Format::Rg32Float));
    read.transparent = pass.read(*depths.transparent, access);
    return read;
}

LightListHandles readLightLists(graph::PassBuilder& pass, const LightListHandles& lists) {
    return {pass.read(lists.tiles, graph::Access::TexelRead),
            pass.read(lists.cells, graph::Access::TexelRead),
            pass.read(lists.entries, graph::Access::TexelRead),
            {}};
}

std::vector<graph::ImportedBuffer> LightListBuffers::imported(const LightListHandles& handles) const {
    std::vector<graph::ImportedBuffer> buffers{
        {handles.tiles, &tiles.buffer()}, {handles.cells, &cells.buffer()}, {handles.entries, &entries.buffer()}};
    if (handles.reach) buffers.push_back({*handles.reach, &reach.buffer()});
    return buffers;
}

void LightListBuffers::requireTiles(std::size_t count) {
    tiles.require(count);
}

void LightListBuffers::requireLists(std::size_t cellCount, std::size_t entryCount) {
    cells.require(cellCount);
    entries.require(entryCount);
}

void LightListBuffers::upload(const culling::LightLists& lists) {
    requireTiles(lists.tiles.size());
    requireLists(lists.cells.size(), lists.entries.size());
    tiles.buffer().upload(lists.tiles);
    cells.buffer().upload(lists.cells);
    entries.buffer().upload(lists.entries);
}

culling::LightLists LightListBuffers::download() const {
    culling::LightLists lists;
    const auto all = [](const GrowingTexelBuffer& from, auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        values = from.buffer().downloadAs<Value>(from.used() * from.texelBytes() / sizeof(Value));
    };
    all(tiles, lists.tiles);
    all(cells, lists.cells);
    all(entries, lists.entries);
    return lists;
}

void LightListBuffers::bind() const {
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_TILES, tiles.texels());
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_CELLS, cells.texels());
    gpu::bindTexelBuffer(TEXTURE_UNIT_LIGHT_ENTRIES, entries.texels());
}

} // namespace tessera::frame
