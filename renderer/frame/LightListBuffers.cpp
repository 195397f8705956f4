#include "renderer/frame/LightListBuffers.h"

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::frame {

LightListHandles readLightLists(graph::PassBuilder& pass, const LightListHandles& lists) {
    return {pass.read(lists.tiles, graph::Access::TexelRead), pass.read(lists.cells, graph::Access::TexelRead),
            pass.read(lists.entries, graph::Access::TexelRead)};
}

void LightListBuffers::upload(const culling::LightLists& lists) {
    tiles.require(lists.tiles.size());
    cells.require(lists.cells.size());
    entries.require(lists.entries.size());
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
