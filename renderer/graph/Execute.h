#pragma once
#include <span>
#include <string_view>

#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// What a compiled graph runs on. The OpenGL one is gpu::GraphBackend; tests use one that records its calls.
class Backend {
public:
    virtual ~Backend() = default;
    /// Provides the allocations of this frame; a backend keeps and reuses them across frames of equal shape.
    virtual void allocate(std::span<const ResourceDesc> allocations) = 0;
    virtual const gpu::Texture& texture(int physical) = 0;
    virtual const gpu::Buffer& buffer(int physical) = 0;
    /// Opens debug group and timers of a pass, after the barrier; `endPass` closes them, also when the pass throws.
    virtual void beginPass(std::string_view name, Barrier barrier) = 0;
    virtual void endPass(std::string_view name) = 0;
};

/// The outside resources behind Graph::import().
struct ImportedTexture {
    TextureHandle handle;
    const gpu::Texture* texture;
};
struct ImportedBuffer {
    BufferHandle handle;
    const gpu::Buffer* buffer;
};

/// Where a graph's resources are while (and after) it runs.
class Execution {
public:
    Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend,
              std::span<const ImportedTexture> textures = {}, std::span<const ImportedBuffer> buffers = {});
    /// Runs every pass of the plan in order.
    void run();
    /// A resource after run(); only outputs and imported ones still hold what was written.
    const gpu::Texture& texture(TextureHandle handle) const;
    const gpu::Buffer& buffer(BufferHandle handle) const;

private:
    const Graph& graph_;
    const CompiledGraph& compiled_;
    Backend& backend_;
    std::vector<ImportedTexture> importedTextures_;
    std::vector<ImportedBuffer> importedBuffers_;
};

} // namespace tessera::graph
