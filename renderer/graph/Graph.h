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

/// The render graph: declares a frame's passes and the resources they read and write, independent of OpenGL. compile()
/// (Compile.h) validates and schedules them, an Execution (Execute.h) runs them on a Backend.
namespace tessera::gpu {
class Texture;
class Buffer;
class Program;
} // namespace tessera::gpu

namespace tessera::graph {

class Graph;

/// A render target: one level and layer of a texture.
struct Target {
    const gpu::Texture* texture = nullptr;
    Part part;
    Target(const gpu::Texture* ofTexture = nullptr, const Part& itsPart = {}) : texture(ofTexture), part(itsPart) {}
};

/// Declares the resources and programs of a pass, in its setup function. Attachments and images are one level and layer
/// of a texture; every other access covers the whole texture.
class PassBuilder {
public:
    /// Creates a transient resource, first written by this pass.
    TextureHandle create(std::string name, const TextureDesc& desc, Access write = Access::ColorAttachment,
                         const Part& part = {});
    BufferHandle create(std::string name, const BufferDesc& desc, Access write = Access::StorageWrite);

    TextureHandle read(TextureHandle handle, Access access = Access::Sampled, const Part& part = {});
    BufferHandle read(BufferHandle handle, Access access = Access::StorageRead);

    /// Modifies a resource (a blend, a depth-tested draw, another layer): depends on the given version and returns the
    /// next.
    TextureHandle write(TextureHandle handle, Access access = Access::ColorAttachment, const Part& part = {});
    BufferHandle write(BufferHandle handle, Access access = Access::StorageWrite);

    /// Requires a format, size and shape of a texture; compile() reports a mismatch. A width, height or sample count of
    /// 0 matches any.
    void expect(TextureHandle handle, const TextureDesc& desc);

    /// Declares a program of this pass and returns its index for PassContext::program(). A compiled graph thus lists
    /// all programs of a frame.
    std::size_t program(ProgramDesc desc);

    /// Exempts the pass from culling, because of its side effects (reports, downloads, presents).
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
    /// Sizes a growing buffer that was created with 0 bytes, once per frame and before any other use of it. A resolved
    /// buffer is thus never replaced within a frame. The buffer may be larger than requested.
    virtual const gpu::Buffer& allocate(BufferHandle handle, std::size_t bytes) const = 0;
    /// The size of a buffer in bytes, from its description or from allocate().
    virtual std::size_t bytes(BufferHandle handle) const = 0;
    /// The pass's program by index, in order of declaration.
    virtual const gpu::Program& program(std::size_t number) const = 0;
    const gpu::Program& program() const { return program(0); }
    /// Binds the render targets that the pass declared, colours in the order of their declaration.
    virtual void bindTargets() const = 0;
    /// Binds a copy of a value as the uniform block at a slot (shaders/shared/slots.h) until the pass ends. Throws
    /// std::logic_error if a program's block there differs in size. Offsets are not checked: they match std140 if
    /// members are vec4, matrices or groups of four 4-byte scalars.
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
        bool stale = false; ///< a write through a handle of a version other than the newest
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
        bool imported = false;           ///< exists outside the frame, which allocates no memory for it
        std::uint32_t newestVersion = 0; ///< 0: before any write
        std::variant<const gpu::Texture*, const gpu::Buffer*> outside = {}; ///< what was imported; null in a plan
        std::optional<std::uint64_t> revision; ///< persistent resources: revision of the contents after the frame
        bool hasContents = false;              ///< may be read before any pass has written it
    };

    /// Whether a resource of this name, shape and revision is left from an earlier frame.
    using Keeps = std::function<bool(const std::string& name, const ResourceDesc& desc, std::uint64_t revision)>;
    /// `keeps` queries the backend (gpu::GraphBackend::holds()). Without it no contents are kept, as in a plan.
    explicit Graph(Keeps keeps = {});
    ~Graph();
    Graph(Graph&&) noexcept;
    Graph& operator=(Graph&&) noexcept;

    /// Declares a pass: `setup(PassBuilder&, Data&)` fills Data with handles immediately, `execute(const Data&, const
    /// PassContext&)` runs later, unless the pass is culled. Returns the filled Data, the pass's typed outputs.
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

    /// Imports a resource that exists outside the frame (a scene's vertices, a window) and outlives it. It can be read
    /// without a producer. Null if the frame is only planned.
    TextureHandle import(std::string name, const TextureDesc& desc, const gpu::Texture* texture = nullptr);
    BufferHandle import(std::string name, const BufferDesc& desc, const gpu::Buffer* buffer = nullptr);

    /// A resource that the backend keeps across frames under its name, such as a cache or a history. `revision`
    /// identifies the input that its contents are computed from. If holds() is false, a pass must write it before
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
