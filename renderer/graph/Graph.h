#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/graph/ProgramDesc.h"
#include "renderer/graph/Resource.h"

/// Declaration of a frame: passes, the resources they read and write, nothing of OpenGL. A recipe declares, compile()
/// (Compile.h) checks and plans, an Execution (Execute.h) runs the plan on a Backend.
namespace tessera::gpu {
class Texture;
class Buffer;
class Program;
} // namespace tessera::gpu

namespace tessera::graph {

class Graph;

/// A texture to rasterise into.
struct Target {
    const gpu::Texture* texture = nullptr;
    Part part;
    Target(const gpu::Texture* ofTexture = nullptr, const Part& itsPart = {}) : texture(ofTexture), part(itsPart) {}
};

/// Handed to a pass's setup function: what is said here is all the graph knows of the pass. Attachments and images are
/// one part of a texture; every other access is of all of it.
class PassBuilder {
public:
    /// A transient resource that this pass is the first to write.
    TextureHandle create(std::string name, const TextureDesc& desc, Access write = Access::ColorAttachment,
                         const Part& part = {});
    BufferHandle create(std::string name, const BufferDesc& desc, Access write = Access::StorageWrite);

    TextureHandle read(TextureHandle handle, Access access = Access::Sampled, const Part& part = {});
    BufferHandle read(BufferHandle handle, Access access = Access::StorageRead);

    /// Adds to what the version holds (a blend, a depth-tested draw, another layer): depends on it, and returns the
    /// next version.
    TextureHandle write(TextureHandle handle, Access access = Access::ColorAttachment, const Part& part = {});
    BufferHandle write(BufferHandle handle, Access access = Access::StorageWrite);

    /// States the format and size that this pass needs of a texture; a difference is a fault of compile(). A width,
    /// height or sample count of 0 stands for any.
    void expect(TextureHandle handle, const TextureDesc& desc);

    /// States a program that this pass runs and returns its number for PassContext::program(), counted from 0. So the
    /// programs of a frame follow from its passes.
    std::size_t program(ProgramDesc desc);

    /// Keeps the pass although nothing reads its outputs (it reports, downloads, presents).
    void keep();

private:
    friend class Graph;
    PassBuilder(Graph& graph, std::uint32_t pass) : graph_(graph), pass_(pass) {}
    Graph& graph_;
    std::uint32_t pass_;
};

/// Resolves handles and programs while a pass executes. Only declared handles and programs are available.
class PassContext {
public:
    virtual ~PassContext() = default;
    virtual const gpu::Texture& texture(TextureHandle handle) const = 0;
    virtual const gpu::Buffer& buffer(BufferHandle handle) const = 0;
    /// Makes room in a buffer that grows and was created with 0 bytes, once a frame and before anything else is asked
    /// of it. So a buffer that was resolved is never replaced while the frame runs. The buffer may be larger than
    /// asked.
    virtual const gpu::Buffer& allocate(BufferHandle handle, std::size_t bytes) const = 0;
    /// The size of a buffer in bytes: that of its description, or that of allocate().
    virtual std::size_t bytes(BufferHandle handle) const = 0;
    /// The pass's program of this number, in the order in which it declared them.
    virtual const gpu::Program& program(std::size_t number) const = 0;
    const gpu::Program& program() const { return program(0); }
    /// Binds the render targets that the pass declared, colours in the order of their declaration.
    virtual void bindTargets() const = 0;
    /// Binds a copy of a value as the uniform block at a slot (shaders/shared/slots.h) until the pass ends. Throws
    /// std::logic_error where a program of the pass has a block of another size there. Offsets are not compared: of
    /// members that are vec4, matrices or runs of four 4-byte scalars they are those of std140.
    template <typename T>
    void constants(std::uint32_t slot, const T& value) const {
        static_assert(std::is_trivially_copyable_v<T>);
        bindConstants(slot, std::as_bytes(std::span(&value, 1)));
    }

protected:
    virtual void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes) const = 0;
};

class Graph {
public:
    struct Use {
        std::uint32_t resource;
        std::uint32_t version; ///< the version read, or the version that the write produced
        std::uint32_t handed;  ///< the version of the handle that was passed
        Access access;
        bool isWrite;
        bool isTexture;     ///< the kind of the handle that was passed
        bool stale = false; ///< a write that was handed a version other than the newest
        Part part = {};     ///< of an attachment or an image
    };
    struct Expectation {
        std::uint32_t resource;
        TextureDesc desc;
    };
    struct Pass {
        std::string name;
        std::vector<Use> uses;
        std::vector<Expectation> expectations;
        std::vector<ProgramDesc> programs;
        bool keep = false;
        std::function<void(const PassContext&)> execute;
    };
    struct Resource {
        std::string name;
        ResourceDesc desc;
        bool imported = false;           ///< exists outside the frame, which gives it no memory
        std::uint32_t newestVersion = 0; ///< 0: before any write
        std::variant<const gpu::Texture*, const gpu::Buffer*> outside = {}; ///< what was imported; null in a plan
        std::optional<std::uint64_t> revision; ///< of one that lives across frames: what the frame leaves in it
        bool hasContents = false;              ///< may be read before any pass has written it
    };

    /// Whether a resource of this name, shape and revision is left from an earlier frame.
    using Keeps = std::function<bool(const std::string& name, const ResourceDesc& desc, std::uint64_t revision)>;
    /// `keeps` asks the backend (gpu::GraphBackend::holds()). Without it nothing is left, as in a plan.
    explicit Graph(Keeps keeps = {});
    ~Graph();
    Graph(Graph&&) noexcept;
    Graph& operator=(Graph&&) noexcept;

    /// Declares a pass: `setup(PassBuilder&, Data&)` fills Data with handles at once, `execute(const Data&, const
    /// PassContext&)` runs later, if the pass is not culled. Returns the filled Data, the pass's typed outputs.
    template <typename Data, typename Setup, typename Execute>
    Data addPass(std::string name, Setup&& setup, Execute&& execute) {
        const std::uint32_t pass = beginPass(std::move(name));
        PassBuilder builder(*this, pass);
        auto data = std::make_shared<Data>();
        setup(builder, *data);
        passes_[pass].execute = [data, run = std::forward<Execute>(execute)](const PassContext& context) {
            run(*data, context);
        };
        return *data;
    }

    /// A resource that exists outside the frame (a scene's vertices, a window), and outlives it. Reading it needs no
    /// producer. Null where the frame is only planned.
    TextureHandle import(std::string name, const TextureDesc& desc, const gpu::Texture* texture = nullptr);
    BufferHandle import(std::string name, const BufferDesc& desc, const gpu::Buffer* buffer = nullptr);

    /// A resource that the backend keeps from frame to frame under its name: a cache, a history. `revision` identifies
    /// the input that its contents are computed from. Where holds() is false, a pass of the frame must write it before
    /// another reads it.
    TextureHandle persist(std::string name, const TextureDesc& desc, std::uint64_t revision);
    BufferHandle persist(std::string name, const BufferDesc& desc, std::uint64_t revision);
    /// Whether an earlier frame left a persistent resource in this revision.
    bool holds(TextureHandle handle) const { return resources_.at(handle.resource).hasContents; }
    bool holds(BufferHandle handle) const { return resources_.at(handle.resource).hasContents; }

    /// Declares a result of the frame: passes that contribute to no result are culled.
    void output(TextureHandle handle);
    void output(BufferHandle handle);

    const std::vector<Pass>& passes() const { return passes_; }
    const std::vector<Resource>& resources() const { return resources_; }
    const std::vector<Use>& outputs() const { return outputs_; }
    const TextureDesc& desc(TextureHandle handle) const;

private:
    friend class PassBuilder;
    std::uint32_t beginPass(std::string name);
    std::uint32_t addResource(Resource resource);
    Keeps keeps_;
    std::vector<Pass> passes_;
    std::vector<Resource> resources_;
    std::vector<Use> outputs_;
};

/// Every fault of a graph, one line each, naming pass and resource.
class GraphError : public std::runtime_error {
public:
    explicit GraphError(std::vector<std::string> faults);
    const std::vector<std::string>& faults() const { return faults_; }

private:
    std::vector<std::string> faults_;
};

} // namespace tessera::graph
