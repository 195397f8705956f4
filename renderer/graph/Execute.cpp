#include "renderer/graph/Execute.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/graph/Access.h"

namespace tessera::graph {
namespace {

template <typename Tag>
constexpr const char* kKind = std::is_same_v<Handle<Tag>, TextureHandle> ? "texture" : "buffer";

/// Rethrows the exception being handled, prefixed with the pass's name. Must be called in a catch block.
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

} // namespace

void Backend::endFrame(Barrier barrier) {
    if (barrier == Barrier::None) return;
    beginPass("end of frame", barrier);
    endPass("end of frame");
}

/// Resolves the handles that a pass gave to, or got from, its PassBuilder.
class Execution::Context final : public PassContext {
public:
    Context(Execution& execution, const Graph::Pass& pass) : execution_(execution), pass_(pass) {}
    const gpu::Texture& texture(TextureHandle handle) const override {
        requireDeclared(handle);
        return execution_.resolve(handle);
    }
    const gpu::Buffer& buffer(BufferHandle handle) const override {
        requireDeclared(handle);
        return execution_.resolve(handle);
    }
    const gpu::Buffer& allocate(BufferHandle handle, std::size_t bytes) const override {
        requireDeclared(handle);
        const Graph::Resource& resource = execution_.graph_.resources()[handle.resource];
        const auto& desc = std::get<BufferDesc>(resource.desc);
        if (!desc.grows || desc.bytes > 0)
            throw std::logic_error(
                fmt::format("makes room in '{}', whose bytes are known; only a buffer that grows and "
                            "is created with 0 bytes takes more while the frame runs",
                            resource.name));
        if (execution_.places_[handle.resource].buffer != nullptr)
            throw std::logic_error(fmt::format("makes room in '{}', which has room already", resource.name));
        return execution_.grow(handle.resource, bytes);
    }
    std::size_t bytes(BufferHandle handle) const override {
        requireDeclared(handle);
        return execution_.bytes(handle);
    }
    const gpu::Program& program(std::size_t number) const override {
        if (number >= pass_.programs.size())
            throw std::logic_error(fmt::format("requested its program {}, and declared {}; name it in its setup",
                                               number, pass_.programs.size()));
        if (execution_.programs_ == nullptr) throw std::logic_error("the execution was given no programs");
        return execution_.programs_->get(pass_.programs[number]);
    }
    void bindTargets() const override {
        std::vector<Target> colors;
        Target depth;
        for (const Graph::Use& use : pass_.uses) {
            if (!isAttachment(use.access)) continue;
            const Target target(&execution_.resolve(TextureHandle{use.resource, use.version}), use.part);
            if (use.access == Access::ColorAttachment)
                colors.push_back(target);
            else
                depth = target;
        }
        if (colors.empty() && depth.texture == nullptr)
            throw std::logic_error("binds its targets and declared none; create or write an attachment in its setup");
        execution_.backend_.bindTargets(colors, depth);
    }

protected:
    void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes) const override {
        std::vector<const gpu::Program*> programs;
        for (std::size_t i = 0; i < pass_.programs.size(); ++i) programs.push_back(&program(i));
        execution_.backend_.bindConstants(slot, bytes, programs);
    }

private:
    template <typename Tag>
    void requireDeclared(Handle<Tag> handle) const {
        if (handle.resource >= execution_.graph_.resources().size())
            throw std::logic_error(fmt::format("requested an invalid {} handle", kKind<Tag>));
        const bool declared = std::any_of(pass_.uses.begin(), pass_.uses.end(), [&](const Graph::Use& use) {
            return use.resource == handle.resource && use.isTexture == std::is_same_v<Handle<Tag>, TextureHandle> &&
                   (use.version == handle.version || use.handed == handle.version);
        });
        if (!declared)
            throw std::logic_error(
                fmt::format("requested version {} of '{}', which it did not declare; read or write it in its setup",
                            handle.version, execution_.graph_.resources()[handle.resource].name));
    }

    Execution& execution_;
    const Graph::Pass& pass_;
};

namespace {

bool isOutput(const Graph& graph, std::uint32_t resource) {
    return std::any_of(graph.outputs().begin(), graph.outputs().end(),
                       [&](const Graph::Use& output) { return output.resource == resource; });
}

} // namespace

Execution::Execution(const Graph& graph, const CompiledGraph& compiled, Backend& backend, ProgramSource* programs)
    : graph_(graph), compiled_(compiled), backend_(backend), programs_(programs), places_(graph.resources().size()) {
    for (std::size_t i = 0; i < graph.resources().size(); ++i) {
        const Graph::Resource& resource = graph.resources()[i];
        Place& place = places_[i];
        const bool isUsed = compiled.resources[i].first >= 0 || isOutput(graph, std::uint32_t(i));
        if (!resource.imported || !isUsed) continue;
        const bool isTexture = std::holds_alternative<TextureDesc>(resource.desc);
        if (resource.revision && isTexture)
            place.texture = &backend.persistentTexture(resource.name, std::get<TextureDesc>(resource.desc));
        else if (resource.revision)
            place.buffer = &backend.persistentBuffer(resource.name, std::get<BufferDesc>(resource.desc));
        else if (isTexture)
            place.texture = std::get<const gpu::Texture*>(resource.outside);
        else
            place.buffer = std::get<const gpu::Buffer*>(resource.outside);
        if (place.texture == nullptr && place.buffer == nullptr)
            throw std::logic_error(fmt::format("the frame uses the imported {} '{}', but was declared without it",
                                               isTexture ? "texture" : "buffer", resource.name));
    }
}

/// Index of a resource among those of the same name.
int Execution::numberOf(std::uint32_t resource) const {
    const auto& all = graph_.resources();
    return int(std::count_if(all.begin(), all.begin() + resource,
                             [&](const Graph::Resource& other) { return other.name == all[resource].name; }));
}

const gpu::Buffer& Execution::grow(std::uint32_t resource, std::size_t bytes) {
    Place& place = places_[resource];
    place.bytes = bytes;
    place.buffer = &backend_.growingBuffer(graph_.resources()[resource].name, numberOf(resource), bytes);
    return *place.buffer;
}

void Execution::findGrowing() {
    for (std::uint32_t i = 0; i < graph_.resources().size(); ++i) {
        const auto* desc = std::get_if<BufferDesc>(&graph_.resources()[i].desc);
        if (desc == nullptr || !desc->grows || compiled_.resources[i].first < 0) continue;
        places_[i] = {};
        if (desc->bytes > 0) grow(i, desc->bytes);
    }
}

void Execution::run() {
    hasRun_ = false;
    backend_.allocate(compiled_.allocations);
    findGrowing();
    setRevisions(false); // a failed frame leaves undefined contents
    std::size_t position = 0;
    try {
        for (; position < compiled_.order.size(); ++position) runPass(compiled_.order[position]);
    } catch (...) {
        endFailedFrame(position);
        throw;
    }
    backend_.endFrame(compiled_.after);
    setRevisions(true);
    hasRun_ = true;
}

void Execution::endFailedFrame(std::size_t position) {
    // The next frame reuses this memory, and relies on every store being visible.
    Barrier owed = compiled_.after;
    for (; position < compiled_.order.size(); ++position) owed = owed | compiled_.order[position].before;
    try {
        backend_.endFrame(owed);
    } catch (...) { // the pass's exception is the cause
    }
}

void Execution::setRevisions(bool areWritten) {
    for (const CompiledPass& entry : compiled_.order) {
        for (const Graph::Use& use : graph_.passes()[entry.pass].uses) {
            const Graph::Resource& resource = graph_.resources()[use.resource];
            if (use.isWrite && resource.revision)
                backend_.setRevision(resource.name, areWritten ? resource.revision : std::nullopt);
        }
    }
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
            } catch (...) { // the pass's exception is the cause
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
        throw std::logic_error(fmt::format("an execution got a request for an invalid {} handle", kind));
    const std::string& name = graph_.resources()[resource].name;
    if (!hasRun_) throw std::logic_error(fmt::format("an execution got a request for '{}' before run()", name));
    if (places_[resource].texture != nullptr ||
        (places_[resource].buffer != nullptr && graph_.resources()[resource].imported))
        return;
    for (const Graph::Use& output : graph_.outputs())
        if (output.resource == resource && output.version == version && compiled_.resources[resource].first >= 0)
            return;
    throw std::logic_error(fmt::format("an execution got a request for version {} of '{}', which is no output of the "
                                       "frame, so that other data may have "
                                       "replaced it; declare it with Graph::output()",
                                       version, name));
}

const gpu::Texture& Execution::resolve(TextureHandle handle) const {
    const int physical = compiled_.resources[handle.resource].physical;
    return physical >= 0 ? backend_.texture(physical) : *places_[handle.resource].texture;
}

const gpu::Buffer& Execution::resolve(BufferHandle handle) const {
    const int physical = compiled_.resources[handle.resource].physical;
    if (physical >= 0) return backend_.buffer(physical);
    const gpu::Buffer* const buffer = places_[handle.resource].buffer;
    if (buffer == nullptr)
        throw std::logic_error(fmt::format("requested '{}' before any pass set its size in bytes",
                                           graph_.resources()[handle.resource].name));
    return *buffer;
}

std::size_t Execution::bytes(BufferHandle handle) const {
    const auto& desc = std::get<BufferDesc>(graph_.resources()[handle.resource].desc);
    return desc.grows ? places_[handle.resource].bytes : desc.bytes;
}

} // namespace tessera::graph
