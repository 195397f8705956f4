#include "renderer/graph/Graph.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace tessera::graph {
namespace {

constexpr std::uint32_t kInvalid = TextureHandle::kInvalid;

template <typename Tag>
constexpr bool kIsTexture = std::is_same_v<Handle<Tag>, TextureHandle>;

std::string joinFaults(const std::vector<std::string>& faults) {
    if (faults.size() == 1) return "the render graph is faulty: " + faults.front();
    std::string text = fmt::format("the render graph has {} faults:", faults.size());
    for (const std::string& fault : faults) text += "\n" + fault;
    return text;
}

template <typename Tag>
Graph::Use readOf(Handle<Tag> handle, Access access, const Part& part = {}) {
    return {.resource = handle.resource,
            .version = handle.version,
            .handed = handle.version,
            .access = access,
            .isWrite = false,
            .isTexture = kIsTexture<Tag>,
            .stale = false,
            .part = part};
}

/// Records a write and returns the handle of the new version; an invalid handle stays invalid.
template <typename Tag>
Handle<Tag> writeTo(std::vector<Graph::Resource>& resources, std::vector<Graph::Use>& uses, Handle<Tag> handle,
                    Access access, const Part& part = {}) {
    Graph::Use use = readOf(handle, access, part);
    use.isWrite = true;
    if (handle.resource < resources.size()) {
        std::uint32_t& newest = resources[handle.resource].newestVersion;
        use.stale = handle.version != newest;
        use.version = ++newest;
    }
    uses.push_back(use);
    return {handle.resource, use.version};
}

template <typename Resource>
Graph::Resource imported(std::string name, ResourceDesc desc, const Resource* resource) {
    return {.name = std::move(name),
            .desc = std::move(desc),
            .imported = true,
            .outside = resource,
            .revision = {},
            .hasContents = true};
}

Graph::Resource kept(std::string name, ResourceDesc desc, std::uint64_t revision, bool holds) {
    return {
        .name = std::move(name), .desc = std::move(desc), .imported = true, .revision = revision, .hasContents = holds};
}

} // namespace

int mipLevelsFor(int width, int height) {
    return std::bit_width(unsigned(std::max({width, height, 1})));
}

TextureDesc mipDesc(const TextureDesc& desc, int level) {
    TextureDesc result = desc;
    result.width = std::max(1, desc.width >> level);
    result.height = std::max(1, desc.height >> level);
    result.levels = 1;
    return result;
}

std::size_t descBytes(const ResourceDesc& desc) {
    if (const auto* buffer = std::get_if<BufferDesc>(&desc)) return buffer->bytes;
    const auto& texture = std::get<TextureDesc>(desc);
    std::size_t texels = 0;
    for (int level = 0; level < texture.levels; ++level) {
        const TextureDesc size = mipDesc(texture, level);
        texels += std::size_t(size.width) * std::size_t(size.height) * std::size_t(size.layers);
    }
    return texels * std::size_t(texture.samples) * std::size_t(formatInfo(texture.format).bytes);
}

TextureHandle PassBuilder::create(std::string name, const TextureDesc& desc, Access access, const Part& part) {
    return write(TextureHandle{graph_.addResource({.name = std::move(name), .desc = desc, .revision = {}}), 0}, access,
                 part);
}

BufferHandle PassBuilder::create(std::string name, const BufferDesc& desc, Access access) {
    return write(BufferHandle{graph_.addResource({.name = std::move(name), .desc = desc, .revision = {}}), 0}, access);
}

TextureHandle PassBuilder::read(TextureHandle handle, Access access, const Part& part) {
    graph_.passes_[pass_].uses.push_back(readOf(handle, access, part));
    return handle;
}

BufferHandle PassBuilder::read(BufferHandle handle, Access access) {
    graph_.passes_[pass_].uses.push_back(readOf(handle, access));
    return handle;
}

TextureHandle PassBuilder::write(TextureHandle handle, Access access, const Part& part) {
    return writeTo(graph_.resources_, graph_.passes_[pass_].uses, handle, access, part);
}

BufferHandle PassBuilder::write(BufferHandle handle, Access access) {
    return writeTo(graph_.resources_, graph_.passes_[pass_].uses, handle, access);
}

void PassBuilder::expect(TextureHandle handle, const TextureDesc& desc) {
    graph_.passes_[pass_].expectations.push_back({handle.resource, desc});
}

std::size_t PassBuilder::program(ProgramDesc desc) {
    std::vector<ProgramDesc>& programs = graph_.passes_[pass_].programs;
    programs.push_back(std::move(desc));
    return programs.size() - 1;
}

void PassBuilder::keep() {
    graph_.passes_[pass_].keep = true;
}

Graph::Graph(Keeps keeps) : keeps_(std::move(keeps)) {}
Graph::~Graph() = default;
Graph::Graph(Graph&&) noexcept = default;
Graph& Graph::operator=(Graph&&) noexcept = default;

TextureHandle Graph::import(std::string name, const TextureDesc& desc, const gpu::Texture* texture) {
    return {addResource(imported(std::move(name), desc, texture)), 0};
}

BufferHandle Graph::import(std::string name, const BufferDesc& desc, const gpu::Buffer* buffer) {
    return {addResource(imported(std::move(name), desc, buffer)), 0};
}

TextureHandle Graph::persist(std::string name, const TextureDesc& desc, std::uint64_t revision) {
    const bool holds = keeps_ && keeps_(name, desc, revision);
    return {addResource(kept(std::move(name), desc, revision, holds)), 0};
}

BufferHandle Graph::persist(std::string name, const BufferDesc& desc, std::uint64_t revision) {
    const bool holds = keeps_ && keeps_(name, desc, revision);
    return {addResource(kept(std::move(name), desc, revision, holds)), 0};
}

void Graph::output(TextureHandle handle) {
    outputs_.push_back(readOf(handle, Access::Download));
}
void Graph::output(BufferHandle handle) {
    outputs_.push_back(readOf(handle, Access::Download));
}

const TextureDesc& Graph::desc(TextureHandle handle) const {
    if (handle.resource == kInvalid) throw std::logic_error("Graph::desc got an invalid texture handle");
    if (handle.resource >= resources_.size() || !std::holds_alternative<TextureDesc>(resources_[handle.resource].desc))
        throw std::logic_error("Graph::desc got a texture handle of another graph");
    return std::get<TextureDesc>(resources_[handle.resource].desc);
}

std::uint32_t Graph::beginPass(std::string name) {
    passes_.push_back(
        {.name = std::move(name), .uses = {}, .expectations = {}, .programs = {}, .keep = false, .execute = {}});
    return std::uint32_t(passes_.size() - 1);
}

std::uint32_t Graph::addResource(Resource resource) {
    resources_.push_back(std::move(resource));
    return std::uint32_t(resources_.size() - 1);
}

GraphError::GraphError(std::vector<std::string> faults)
    : std::runtime_error(joinFaults(faults)), faults_(std::move(faults)) {}

} // namespace tessera::graph
