#include "renderer/frame/LobesGpu.h"

#include <span>
#include <vector>

#include "renderer/frame/ComputedCache.h"
#include "renderer/frame/LobeShapes.h"
#include "shaders/shared/lobe_shapes.h"
#include "shaders/shared/lobe_table.h"

namespace tessera::frame {

LobesGpu::LobesGpu() : smooth_(gpu::Sampler::linearClamp()) {}

graph::TextureDesc LobesGpu::tableDesc() {
    return {graph::Format::Rgba32Float, LOBE_TABLE_SIDE, LOBE_TABLE_SIDE, 1, 1, LOBE_TABLE_LAYERS, graph::Shape::Array};
}

graph::TextureDesc LobesGpu::shapesDesc() {
    return {graph::Format::Rgba32Float, LOBE_SHAPES_SIDE, LOBE_SHAPES_SIDE};
}

const gpu::Texture& LobesGpu::table() {
    if (table_) return *table_;
    auto texture = std::make_unique<gpu::Texture>("lobe_table", tableDesc());
    static const std::vector<glm::vec4> table = cachedLobeTable(cacheFolder());
    const std::size_t layer = std::size_t(LOBE_TABLE_SIDE) * LOBE_TABLE_SIDE;
    for (std::size_t i = 0; i < std::size_t(LOBE_TABLE_LAYERS); ++i)
        texture->upload(0, std::span(table).subspan(i * layer, layer), int(i));
    table_ = std::move(texture);
    return *table_;
}

const gpu::Texture& LobesGpu::shapes() {
    if (shapes_) return *shapes_;
    auto texture = std::make_unique<gpu::Texture>("lobe_shapes", shapesDesc());
    texture->upload(0, lobeShapes());
    shapes_ = std::move(texture);
    return *shapes_;
}

} // namespace tessera::frame
