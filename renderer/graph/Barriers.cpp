#include "renderer/graph/Barriers.h"

#include "renderer/graph/Access.h"

namespace tessera::graph {
namespace {

constexpr Barrier kAll = Barrier::TextureFetch | Barrier::ShaderImage | Barrier::ShaderStorage | Barrier::Uniform |
                         Barrier::Framebuffer | Barrier::TransferOrUpdate | Barrier::VertexAttribute |
                         Barrier::ElementArray | Barrier::Command;
constexpr Barrier kStores = Barrier::ShaderImage | Barrier::ShaderStorage;

constexpr Barrier without(Barrier a, Barrier b) {
    return Barrier(std::uint32_t(a) & ~std::uint32_t(b));
}

/// Barrier bits not yet issued since the last store to, and the last load from, a piece of memory.
struct Memory {
    Barrier sinceStore = Barrier::None;
    Barrier sinceLoad = kStores; ///< an earlier frame may have read it
};

} // namespace

void placeBarriers(const Graph& graph, CompiledGraph& compiled) {
    std::vector<Memory> memories(compiled.allocations.size() + compiled.resources.size());
    const auto memoryOf = [&](const Graph::Use& use) -> Memory& {
        const int physical = compiled.resources[use.resource].physical;
        return memories[physical >= 0 ? std::size_t(physical) : compiled.allocations.size() + use.resource];
    };
    for (CompiledPass& entry : compiled.order) {
        const Graph::Pass& pass = graph.passes()[entry.pass];
        entry.before = Barrier::None;
        for (const Graph::Use& use : pass.uses) {
            const AccessInfo& access = accessInfo(use.access);
            entry.before = entry.before | (memoryOf(use).sinceStore & access.barrier);
            if (access.incoherent) entry.before = entry.before | (memoryOf(use).sinceLoad & access.barrier);
        }
        for (Memory& memory : memories) {
            memory.sinceStore = without(memory.sinceStore, entry.before);
            memory.sinceLoad = without(memory.sinceLoad, entry.before);
        }
        for (const Graph::Use& use : pass.uses) {
            if (accessInfo(use.access).incoherent) memoryOf(use).sinceStore = kAll;
            if (accessInfo(use.access).readsInShader) memoryOf(use).sinceLoad = kStores;
        }
    }
    compiled.after = Barrier::None;
    for (const Memory& memory : memories) compiled.after = compiled.after | memory.sinceStore;
}

} // namespace tessera::graph
