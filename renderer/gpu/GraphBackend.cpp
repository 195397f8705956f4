#include "renderer/gpu/GraphBackend.h"

#include <cassert>

#include <fmt/format.h>

#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Context.h"

namespace tessera::gpu {
namespace {

std::string poolLabel(const graph::ResourceDesc& desc) {
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc))
        return fmt::format("transient {} {} x {}, {} samples", graph::formatInfo(texture->format).name, texture->width,
                           texture->height, texture->samples);
    return fmt::format("transient buffer, {} bytes", std::get<graph::BufferDesc>(desc).bytes);
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
    auto pooled = std::make_unique<Pooled>();
    pooled->desc = desc;
    if (const auto* texture = std::get_if<graph::TextureDesc>(&desc))
        pooled->resource = std::make_unique<Texture>(poolLabel(desc), *texture);
    else
        pooled->resource = std::make_unique<Buffer>(poolLabel(desc), std::get<graph::BufferDesc>(desc).bytes);
    pooled->taken = true;
    return *pool_.emplace_back(std::move(pooled));
}

void GraphBackend::allocate(std::span<const graph::ResourceDesc> allocations) {
    frame_.clear();
    runsOfName_.clear();
    physical_.clear();
    for (const auto& pooled : pool_) {
        pooled->taken = false;
        ++pooled->idleFrames;
    }
    for (const graph::ResourceDesc& desc : allocations) physical_.push_back(&take(desc));
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
    askToGoOn();
}

void GraphBackend::endFrame(graph::Barrier barrier) {
    memoryBarrier(barrier);
    throwIfFailed("at the end of the frame");
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
    return bytes;
}

} // namespace tessera::gpu
