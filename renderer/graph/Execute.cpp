#include "renderer/graph/Execute.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "scenes/Error.h"

namespace tessera::graph {
namespace {

template <typename Tag>
constexpr const char* kKind = std::is_same_v<Handle<Tag>, TextureHandle> ? "texture" : "buffer";

/// Throws on what a pass threw, with the pass's name in front. To be called while that exception is handled.
[[noreturn]] void rethrowNaming(const std::string& pass) {
    const auto named = [&](const std::exception& error) { return fmt::format("pass '{}': {}", pass, error.what()); };
    try {
        throw;
    } catch (const Interrupted&) {
        throw;
    } catch (const InputError& error) {
        std::throw_with_nested(InputError(named(error)));
    } catch (const std::logic_error& error) {
        std::throw_with_nested(std::logic_error(named(error)));
    } catch (const std::exception& error) {
        std::throw_with_nested(std::runtime_error(named(error)));
    } catch (...) {
        std::throw_with_nested(std::runtime_error(fmt::format("pass '{}': an exception of unknown type", pass)));
    }
}

template <typename Tag, typename Resource>
void take(const Graph& graph, Handle<Tag> handle, const Resource* resource, std::vector<const Resource*>& byResource) {
    if (handle.resource >= graph.resources().size() || !graph.resources()[handle.resource].imported)
        throw std::logic_error(
            fmt::format("an execution was given a {} for a handle that import() did not return", kKind<Tag>));
    byResource[handle.resource] = resource;
}

} // namespace

void Backend::endFrame(Barrier barrier) {
    if (barrier == Barrier::None) return;
    beginPass("end of frame", barrier);
    endPass("end of frame");
}

/// What one pass may ask for: the handles it was given by, or handed to, its PassBuilder.
class Execution::Context final : public PassContext {
public:
    Context(const Execution& execution, const Graph::Pass& pass) : execution_(execution), pass_(pass) {}
    const gpu::Texture& texture(TextureHandle handle) const override {
        requireDeclared(handle);
        return execution_.resolve(handle);
    }
    const gpu::Buffer& buffer(BufferHandle handle) const override {
        requireDeclared(handle);
        return execution_.resolve(handle);
    }

private:
    template <typename Tag>
    void requireDeclared(Handle<Tag> handle) const {
        if (handle.resource >= execution_.graph_.resources().size())
            throw std::logic_error(fmt::format("asked for an invalid {} handle", kKind<Tag>));
        const bool declared = std::any_of(pass_.uses.begin(), pass_.uses.end(), [&](const Graph::Use& use) {
            return use.resource == handle.resource && use.isTexture == std::is_same_v<Handle<Tag>, TextureHandle> &&
                   (use.version == handle.version || use.handed == handle.version);
        });
        if (!declared)
            throw std::logic_error(
                fmt::format("asked for version {} of '{}', which it did not declare; read or write it in its setup",
                            handle.version, execution_.graph_.resources()[handle.resource].name));
    }

    const Execution& execution_;
    const Graph::Pass& pass_;
};

Execution::Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend,
                     std::span<const ImportedTexture> textures, std::span<const ImportedBuffer> buffers)
    : graph_(graph), compiled_(compiled), backend_(backend), importedTextures_(graph.resources().size()),
      importedBuffers_(graph.resources().size()) {
    for (const ImportedTexture& imported : textures) take(graph, imported.handle, imported.texture, importedTextures_);
    for (const ImportedBuffer& imported : buffers) take(graph, imported.handle, imported.buffer, importedBuffers_);
    for (std::size_t i = 0; i < graph.resources().size(); ++i) {
        const Graph::Resource& resource = graph.resources()[i];
        const bool isTexture = std::holds_alternative<TextureDesc>(resource.desc);
        const bool given = isTexture ? importedTextures_[i] != nullptr : importedBuffers_[i] != nullptr;
        if (resource.imported && compiled.resources[i].first >= 0 && !given)
            throw std::logic_error(fmt::format("the frame uses the imported {} '{}', but the execution was given none",
                                               isTexture ? "texture" : "buffer", resource.name));
    }
}

void Execution::run() {
    hasRun_ = false;
    backend_.allocate(compiled_.allocations);
    for (const CompiledPass& pass : compiled_.order) runPass(pass);
    backend_.endFrame(compiled_.after);
    hasRun_ = true;
}

void Execution::runPass(const CompiledPass& compiledPass) {
    const Graph::Pass& pass = graph_.passes()[compiledPass.pass];
    bool open = false;
    try {
        backend_.beginPass(pass.name, compiledPass.before);
        open = true;
        pass.execute(Context(*this, pass));
        open = false;
        backend_.endPass(pass.name);
    } catch (...) {
        const std::exception_ptr cause = std::current_exception();
        if (open) {
            try {
                backend_.endPass(pass.name);
            } catch (...) { // what the pass threw first is the cause, and says more
            }
        }
        try {
            std::rethrow_exception(cause);
        } catch (...) {
            rethrowNaming(pass.name);
        }
    }
}

const gpu::Texture& Execution::texture(TextureHandle handle) const {
    requireKept(handle.resource, handle.version, true);
    return resolve(handle);
}

const gpu::Buffer& Execution::buffer(BufferHandle handle) const {
    requireKept(handle.resource, handle.version, false);
    return resolve(handle);
}

void Execution::requireKept(std::uint32_t resource, std::uint32_t version, bool isTexture) const {
    const char* kind = isTexture ? "texture" : "buffer";
    if (resource >= graph_.resources().size() ||
        std::holds_alternative<TextureDesc>(graph_.resources()[resource].desc) != isTexture)
        throw std::logic_error(fmt::format("an execution was asked for an invalid {} handle", kind));
    const std::string& name = graph_.resources()[resource].name;
    if (!hasRun_) throw std::logic_error(fmt::format("an execution was asked for '{}' before run()", name));
    if (isTexture ? importedTextures_[resource] != nullptr : importedBuffers_[resource] != nullptr) return;
    for (const Graph::Use& output : graph_.outputs())
        if (output.resource == resource && output.version == version && compiled_.resources[resource].first >= 0)
            return;
    throw std::logic_error(fmt::format(
        "an execution was asked for version {} of '{}', which is no output of the frame, so that other data may have "
        "replaced it; declare it with Graph::output()",
        version, name));
}

const gpu::Texture& Execution::resolve(TextureHandle handle) const {
    const int physical = compiled_.resources[handle.resource].physical;
    return physical >= 0 ? backend_.texture(physical) : *importedTextures_[handle.resource];
}

const gpu::Buffer& Execution::resolve(BufferHandle handle) const {
    const int physical = compiled_.resources[handle.resource].physical;
    return physical >= 0 ? backend_.buffer(physical) : *importedBuffers_[handle.resource];
}

} // namespace tessera::graph
