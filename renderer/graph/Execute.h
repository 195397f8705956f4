#pragma once
#include <exception>
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
    /// Issues CompiledGraph::after when every pass has run. By default a pass of its own, "end of frame", where there
    /// is a barrier to issue.
    virtual void endFrame(Barrier barrier);
};

/// Thrown through a frame that whoever asked for it gives up; no failure, so no pass's name is put in front.
class Interrupted : public std::exception {
public:
    const char* what() const noexcept override { return "the frame was given up"; }
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

/// Where a graph's resources are while (and after) it runs. Graph, compiled graph, backend and imported resources must
/// outlive it.
class Execution {
public:
    /// Throws std::logic_error when a resource that the frame imports and uses is not given.
    Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend,
              std::span<const ImportedTexture> textures = {}, std::span<const ImportedBuffer> buffers = {});
    /// Runs every pass of the plan in order. What a pass throws is thrown on with the pass's name in front: as
    /// InputError or std::logic_error where it was one, else as std::runtime_error, the original nested inside;
    /// Interrupted as it is.
    void run();
    /// A resource after run(): an output or an imported one, since only these still hold what was written; any other is
    /// a std::logic_error.
    const gpu::Texture& texture(TextureHandle handle) const;
    const gpu::Buffer& buffer(BufferHandle handle) const;

private:
    class Context;
    const gpu::Texture& resolve(TextureHandle handle) const;
    const gpu::Buffer& resolve(BufferHandle handle) const;
    void requireKept(std::uint32_t resource, std::uint32_t version, bool isTexture) const;
    void runPass(const CompiledPass& compiledPass);

    const Graph& graph_;
    const CompiledGraph& compiled_;
    Backend& backend_;
    std::vector<const gpu::Texture*> importedTextures_; ///< by resource
    std::vector<const gpu::Buffer*> importedBuffers_;   ///< by resource
    bool hasRun_ = false;
};

} // namespace tessera::graph
