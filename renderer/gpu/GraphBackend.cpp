#include "renderer/gpu/GraphBackend.h"

#include <cassert>

#include <fmt/format.h>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Context.h"
#include "renderer/gpu/Program.h"
#include "renderer/graph/Access.h"

namespace tessera::gpu {
namespace {

std::string poolLabel(const graph::ResourceDesc& desc) {
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc))
        return fmt::format("transient {} {}", graph::formatInfo(texture->format).name, graph::describeSize(desc));
    return fmt::format("transient buffer, {} bytes", std::get<graph::BufferDesc>(desc).bytes);
}

template <typename Resource>
Resource made(const std::string& label, const graph::ResourceDesc& desc) {
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc)) return std::make_unique<Texture>(label, *texture);
    return std::make_unique<Buffer>(label, std::get<graph::BufferDesc>(desc).bytes);
}

} // namespace

GraphBackend::GraphBackend() : isSoftware_(Context::current()->capabilities().isSoftware) {}
GraphBackend::~GraphBackend() = default;

GraphBackend::Pooled& GraphBackend::take(const graph::ResourceDesc& desc) {
    for (const auto& pooled : pool_) {
        if (pooled->taken || !(pooled->desc == desc)) continue;
        pooled->taken = true;
        pooled->idleFrames = 0;
        return *pooled;
    }
    auto pooled = std::make_unique<Pooled>(Pooled{desc, made<Resource>(poolLabel(desc), desc)});
    pooled->taken = true;
    return *pool_.emplace_back(std::move(pooled));
}

void GraphBackend::allocate(std::span<const graph::ResourceDesc> allocations) {
    frame_.clear();
    runsOfName_.clear();
    physical_.clear();
    for (const auto& pooled : pool_) {
        pooled->taken = false;
        if (countsIdleFrames_) ++pooled->idleFrames;
    }
    for (const graph::ResourceDesc& desc : allocations) {
        physical_.push_back(&take(desc));
        if (clearsAllocations_) std::visit([](const auto& resource) { resource->clear(); }, physical_.back()->resource);
    }
    const auto dropped = std::erase_if(
        pool_, [this](const auto& pooled) { return !pooled->taken && pooled->idleFrames > mostIdleFrames_; });
    if (dropped > 0) framebuffers_.collect();
}

const Texture& GraphBackend::texture(int physical) {
    assert(physical >= 0 && std::size_t(physical) < physical_.size());
    return *std::get<std::unique_ptr<Texture>>(physical_[std::size_t(physical)]->resource);
}

const Buffer& GraphBackend::buffer(int physical) {
    assert(physical >= 0 && std::size_t(physical) < physical_.size());
    return *std::get<std::unique_ptr<Buffer>>(physical_[std::size_t(physical)]->resource);
}

const Buffer& GraphBackend::growingBuffer(const std::string& name, int number, std::size_t bytes) {
    const auto known = growing_.find({name, number});
    if (known != growing_.end() && known->second.bytes() >= bytes) return known->second;
    if (known != growing_.end()) growing_.erase(known); // frees its memory first
    // A quarter more, so that it rarely grows.
    return growing_.emplace(std::pair(name, number), Buffer(name, bytes + bytes / 4, BufferUse::Dynamic)).first->second;
}

GraphBackend::Resource& GraphBackend::persistent(const std::string& name, const graph::ResourceDesc& desc) {
    const auto known = persistent_.find(name);
    if (known != persistent_.end() && known->second.desc == desc) {
        known->second.idleFrames = 0;
        return known->second.resource;
    }
    forget(name);
    return persistent_.emplace(name, Persistent{desc, made<Resource>(name, desc), {}}).first->second.resource;
}

const Texture& GraphBackend::persistentTexture(const std::string& name, const graph::TextureDesc& desc) {
    return *std::get<std::unique_ptr<Texture>>(persistent(name, desc));
}

const Buffer& GraphBackend::persistentBuffer(const std::string& name, const graph::BufferDesc& desc) {
    return *std::get<std::unique_ptr<Buffer>>(persistent(name, desc));
}

void GraphBackend::setRevision(const std::string& name, std::optional<std::uint64_t> revision) {
    persistent_.at(name).revision = revision;
}

bool GraphBackend::holds(const std::string& name, const graph::ResourceDesc& desc, std::uint64_t revision) const {
    const auto known = persistent_.find(name);
    return known != persistent_.end() && known->second.desc == desc && known->second.revision == revision;
}

void GraphBackend::keep(const std::string& name) {
    if (const auto known = persistent_.find(name); known != persistent_.end()) known->second.idleFrames = 0;
}

void GraphBackend::forget(const std::string& name) {
    if (persistent_.erase(name) > 0) framebuffers_.collect();
}

void GraphBackend::bindTargets(std::span<const graph::Target> colors, const graph::Target& depth) {
    bindFramebuffer(framebuffers_.get({{colors.begin(), colors.end()}, depth}));
}

void GraphBackend::bindConstants(std::uint32_t slot, std::span<const std::byte> bytes,
                                 std::span<const Program* const> programs) {
    for (const Program* program : programs) {
        const std::size_t wanted = program->uniformBlockBytes(slot);
        if (wanted != 0 && wanted != bytes.size())
            throw std::logic_error(
                fmt::format("program '{}' has a uniform block of {} bytes at slot {}, and is given {}",
                            program->label(), wanted, slot, bytes.size()));
    }
    constants_.bind(slot, bytes);
}

void GraphBackend::beginPass(std::string_view name, graph::Barrier barrier) {
    assert(!group_ && "passes do not nest");
    memoryBarrier(barrier);
    auto runs = runsOfName_.find(name);
    if (runs == runsOfName_.end()) runs = runsOfName_.emplace(name, 0).first;
    const PassKey& key = frame_.emplace_back(std::string(name), runs->second++);
    PassRecord& record = records_[key];
    if (!isSoftware_ && !record.gpuTimer) record.gpuTimer.emplace(key.first);

    group_ = std::make_unique<DebugGroup>(name);
    if (profiling_) finish();
    clock_.restart();
    if (record.gpuTimer) record.gpuTimer->begin();
}

void GraphBackend::endPass(std::string_view name) {
    assert(group_ && !frame_.empty() && frame_.back().first == name);
    PassRecord& record = records_.at(frame_.back());
    if (record.gpuTimer) record.gpuTimer->end();
    record.cpuMs = clock_.elapsedMs();
    record.profiledMs.reset();
    if (profiling_) {
        finish();
        record.profiledMs = clock_.elapsedMs();
    }
    group_.reset();
    throwIfFailed(fmt::format("in pass '{}'", name));
    endBandedPass();
}

void GraphBackend::endFrame(graph::Barrier barrier) {
    memoryBarrier(barrier);
    throwIfFailed("at the end of the frame");
    // Not earlier: the frame may have been declared to read their contents.
    if (countsIdleFrames_)
        for (auto& [name, kept] : persistent_) ++kept.idleFrames;
    const auto dropped =
        std::erase_if(persistent_, [this](const auto& named) { return named.second.idleFrames > mostIdleFrames_ + 1; });
    if (dropped > 0) framebuffers_.collect();
}

std::vector<PassTiming> GraphBackend::passTimings() {
    std::vector<PassTiming> timings;
    for (const PassKey& key : frame_) {
        PassRecord& record = records_.at(key);
        PassTiming& timing = timings.emplace_back(PassTiming{key.first, record.profiledMs, record.cpuMs});
        if (!timing.gpuMs && record.gpuTimer) timing.gpuMs = record.gpuTimer->latestMs();
    }
    return timings;
}

std::size_t GraphBackend::poolBytes() const {
    std::size_t bytes = 0;
    for (const auto& pooled : pool_) bytes += graph::descBytes(pooled->desc);
    for (const auto& [name, kept] : persistent_) bytes += graph::descBytes(kept.desc);
    for (const auto& [key, buffer] : growing_) bytes += buffer.bytes();
    return bytes;
}

} // namespace tessera::gpu
