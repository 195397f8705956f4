#pragma once
#include <exception>
#include <optional>
#include <span>
#include <string>
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
    /// What lives across frames under a name, made where there is none of that shape.
    virtual const gpu::Texture& persistentTexture(const std::string& name, const TextureDesc& desc) = 0;
    /// The growing buffer of a name, enlarged to at least `bytes`. `number` distinguishes buffers of the same name in a
    /// frame.
    virtual const gpu::Buffer& growingBuffer(const std::string& name, int number, std::size_t bytes) = 0;
    virtual const gpu::Buffer& persistentBuffer(const std::string& name, const BufferDesc& desc) = 0;
    /// Records the revision of a persistent resource's contents; none: its contents are undefined.
    virtual void setRevision(const std::string& name, std::optional<std::uint64_t> revision) = 0;
    /// Binds a framebuffer of these textures.
    virtual void bindTargets(std::span<const Target> colors, const Target& depth) = 0;
    /// Binds a copy of the bytes as the uniform block at a slot. Throws std::logic_error where one of the programs has
    /// a block of another size there.
    virtual void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes,
                               std::span<const gpu::Program* const> programs) = 0;
    /// Opens debug group and timers of a pass, after the barrier; `endPass` closes them, also when the pass throws.
    virtual void beginPass(std::string_view name, Barrier barrier) = 0;
    virtual void endPass(std::string_view name) = 0;
    /// Issues CompiledGraph::after when every pass has run. Where one threw, the barriers of those that did not run are
    /// issued too. By default a pass of its own, "end of frame", where there is a barrier to issue.
    virtual void endFrame(Barrier barrier);
};

/// Where programs come from; shader::ProgramLibrary in the product.
class ProgramSource {
public:
    virtual ~ProgramSource() = default;
    /// The reference holds as long as the source.
    virtual const gpu::Program& get(const ProgramDesc& desc) = 0;
};

/// Thrown to abandon a frame when its caller no longer wants it. It is no failure, so no pass name is added to it.
class Interrupted : public std::exception {
public:
    const char* what() const noexcept override { return "the frame was given up"; }
};

/// Where a graph's resources are while (and after) it runs. Graph, compiled graph, backend, programs and imported
/// resources must outlive it.
class Execution {
public:
    /// Throws std::logic_error where the frame uses an imported resource that is null.
    Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend, ProgramSource* programs = nullptr);
    /// Runs every pass of the plan in order. What a pass throws is thrown on with the pass's name in front: as
    /// InputError or std::logic_error where it was one, else as std::runtime_error, the original nested inside;
    /// Interrupted as it is. The next frame runs as after one that ended well.
    void run();
    /// A resource after run(): an output or an imported one, since only these still hold what was written; any other is
    /// a std::logic_error.
    const gpu::Texture& texture(TextureHandle handle) const;
    const gpu::Buffer& buffer(BufferHandle handle) const;
    /// The bytes that a buffer holds, as PassContext::bytes().
    std::size_t bytes(BufferHandle handle) const;

private:
    class Context;
    const gpu::Texture& resolve(TextureHandle handle) const;
    const gpu::Buffer& resolve(BufferHandle handle) const;
    void requireKept(std::uint32_t resource, std::uint32_t version, bool isTexture) const;
    void runPass(const CompiledPass& compiledPass);
    /// Ends a frame that threw in the pass at this position.
    void endFailedFrame(std::size_t position);
    void setRevisions(bool areWritten);

    const Graph& graph_;
    const CompiledGraph& compiled_;
    Backend& backend_;
    ProgramSource* programs_; ///< null where no pass has one
    struct Place {
        const gpu::Texture* texture = nullptr;
        const gpu::Buffer* buffer = nullptr;
        std::size_t bytes = 0; ///< of a buffer that grows
    };
    void findGrowing();
    const gpu::Buffer& grow(std::uint32_t resource, std::size_t bytes);
    int numberOf(std::uint32_t resource) const;
    std::vector<Place>
        places_; ///< by resource, of those that have no allocation of this frame: imported, kept, growing
    bool hasRun_ = false;
};

} // namespace tessera::graph
