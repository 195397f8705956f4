#pragma once
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// Executes a compiled graph. gpu::GraphBackend implements it with OpenGL; tests use one that records its calls.
class Backend {
public:
    virtual ~Backend() = default;
    /// Provides the allocations of this frame; a backend keeps and reuses them across frames of equal shape.
    virtual void allocate(std::span<const ResourceDesc> allocations) = 0;
    virtual const gpu::Texture& texture(int physical) = 0;
    virtual const gpu::Buffer& buffer(int physical) = 0;
    /// The persistent texture of a name, created if there is none of that shape.
    virtual const gpu::Texture& persistentTexture(const std::string& name, const TextureDesc& desc) = 0;
    /// The growing buffer of a name, enlarged to at least `bytes`. `number` distinguishes buffers of the same name in a
    /// frame.
    virtual const gpu::Buffer& growingBuffer(const std::string& name, int number, std::size_t bytes) = 0;
    virtual const gpu::Buffer& persistentBuffer(const std::string& name, const BufferDesc& desc) = 0;
    /// Records the revision of a persistent resource's contents; none: its contents are undefined.
    virtual void setRevision(const std::string& name, std::optional<std::uint64_t> revision) = 0;
    /// Binds a framebuffer of these textures.
    virtual void bindTargets(std::span<const Target> colors, const Target& depth) = 0;
    /// Binds a copy of the bytes as the uniform block at a slot. Throws std::logic_error if a program's block there
    /// differs in size.
    virtual void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes,
                               std::span<const gpu::Program* const> programs) = 0;
    /// Issues the barrier, then opens debug group and timers of a pass; `endPass` closes them, even if the pass throws.
    virtual void beginPass(std::string_view name, Barrier barrier) = 0;
    virtual void endPass(std::string_view name) = 0;
    /// Issues CompiledGraph::after after the last pass; if a pass threw, also the barriers of passes that did not run.
    /// The default runs an empty pass, "end of frame", if there is a barrier.
    virtual void endFrame(Barrier barrier);
};

/// Provides programs; shader::ProgramLibrary outside of tests.
class ProgramSource {
public:
    virtual ~ProgramSource() = default;
    /// The reference is valid as long as the source.
    virtual const gpu::Program& get(const ProgramDesc& desc) = 0;
};

/// Thrown to abandon a frame that is no longer wanted. Not an error, so no pass name is added to it.
class Interrupted : public std::exception {
public:
    const char* what() const noexcept override { return "the frame was given up"; }
};

/// Runs a compiled graph, and resolves its resources during and after the run. Graph, compiled graph, backend, programs
/// and imported resources must outlive it.
class Execution {
public:
    /// Throws std::logic_error if the frame uses an imported resource that is null.
    Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend, ProgramSource* programs = nullptr);
    /// Runs every pass in order. Rethrows the exception of a pass prefixed with its name, the original nested inside:
    /// as InputError or std::logic_error if it was one, else as std::runtime_error; Interrupted unchanged. The next
    /// frame runs as after a successful one.
    void run();
    /// An output or imported resource after run(). Throws std::logic_error for others, whose contents are not kept.
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
    ProgramSource* programs_; ///< null if no pass uses programs
    struct Place {
        const gpu::Texture* texture = nullptr;
        const gpu::Buffer* buffer = nullptr;
        std::size_t bytes = 0; ///< of a growing buffer
    };
    void findGrowing();
    const gpu::Buffer& grow(std::uint32_t resource, std::size_t bytes);
    int numberOf(std::uint32_t resource) const;
    std::vector<Place>
        places_; ///< by resource, for those without an allocation of this frame: imported, persistent, growing
    bool hasRun_ = false;
};

} // namespace tessera::graph
