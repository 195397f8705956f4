#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "renderer/graph/Resource.h"

/// Declaration of a frame: passes, the resources they read and write, nothing of OpenGL. A recipe declares, compile()
/// (Compile.h) checks and plans, an Execution (Execute.h) runs the plan on a Backend.
namespace tessera::gpu {
class Texture;
class Buffer;
} // namespace tessera::gpu

namespace tessera::graph {

class Graph;

/// Handed to a pass's setup function: what is said here is all the graph knows of the pass.
class PassBuilder {
public:
    /// A transient resource that this pass is the first to write.
    TextureHandle create(std::string name, const TextureDesc& desc, Access write = Access::ColorAttachment);
    BufferHandle create(std::string name, const BufferDesc& desc, Access write = Access::StorageWrite);

    TextureHandle read(TextureHandle handle, Access access = Access::Sampled);
    BufferHandle read(BufferHandle handle, Access access = Access::StorageRead);

    /// Adds to what the version holds (a blend, a depth-tested draw): depends on it, and returns the next version.
    TextureHandle write(TextureHandle handle, Access access = Access::ColorAttachment);
    BufferHandle write(BufferHandle handle, Access access = Access::StorageWrite);

    /// States what this pass needs of a texture it uses; a difference is a fault of compile(). A width, height or
    /// sample count of 0 stands for any.
    void expect(TextureHandle handle, const TextureDesc& desc);

    /// Keeps the pass though nobody needs its outputs (it reports, downloads, presents).
    void keep();

private:
    friend class Graph;
    PassBuilder(Graph& graph, std::uint32_t pass) : graph_(graph), pass_(pass) {}
    Graph& graph_;
    std::uint32_t pass_;
};

/// Resolves handles while a pass executes. Only handles the pass declared may be asked for.
class PassContext {
public:
    virtual ~PassContext() = default;
    virtual const gpu::Texture& texture(TextureHandle handle) const = 0;
    virtual const gpu::Buffer& buffer(BufferHandle handle) const = 0;
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
    };
    struct Expectation {
        std::uint32_t resource;
        TextureDesc desc;
    };
    struct Pass {
        std::string name;
        std::vector<Use> uses;
        std::vector<Expectation> expectations;
        bool keep = false;
        std::function<void(const PassContext&)> execute;
    };
    struct Resource {
        std::string name;
        ResourceDesc desc;
        bool imported = false;
        std::uint32_t newestVersion = 0; ///< 0: before any write
    };

    Graph();
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

    /// A resource that exists outside the frame (a history, a window). Reading it needs no producer. A
    /// buffer of 0 bytes is one whose owner sizes it while the frame runs.
    TextureHandle import(std::string name, const TextureDesc& desc);
    BufferHandle import(std::string name, const BufferDesc& desc);

    /// Declares what the frame is for: passes that do not lead here are culled.
    void output(TextureHandle handle);
    void output(BufferHandle handle);

    const std::vector<Pass>& passes() const { return passes_; }
    const std::vector<Resource>& resources() const { return resources_; }
    const std::vector<Use>& outputs() const { return outputs_; }
    const TextureDesc& desc(TextureHandle handle) const;

private:
    friend class PassBuilder;
    std::uint32_t beginPass(std::string name);
    std::uint32_t addResource(std::string name, ResourceDesc desc, bool imported);
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
