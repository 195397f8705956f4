#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// The memory barrier before a pass that follows shader stores to images or storage buffers: a bit set that the backend
/// maps to glMemoryBarrier bits (rules: Barriers.h).
enum class Barrier : std::uint32_t {
    None = 0,
    TextureFetch = 1u << 0,
    ShaderImage = 1u << 1,
    ShaderStorage = 1u << 2,
    Uniform = 1u << 3,
    Framebuffer = 1u << 4,
    TransferOrUpdate = 1u << 5,
    VertexAttribute = 1u << 6,
    ElementArray = 1u << 7,
    Command = 1u << 8
};
constexpr Barrier operator|(Barrier a, Barrier b) {
    return Barrier(std::uint32_t(a) | std::uint32_t(b));
}
constexpr Barrier operator&(Barrier a, Barrier b) {
    return Barrier(std::uint32_t(a) & std::uint32_t(b));
}

struct CompiledPass {
    std::uint32_t pass; ///< index into Graph::passes()
    Barrier before = Barrier::None;
};

struct CompiledResource {
    std::uint32_t resource; ///< index into Graph::resources()
    std::size_t bytes = 0;
    int first = -1;    ///< position in CompiledGraph::order of the first use; -1: unused
    int last = -1;     ///< position of the last use; outputs live to the end of the frame
    int physical = -1; ///< index of the allocation it lives in; -1 for imported, growing and unused resources
    int aliasOf = -1;  ///< the resource (index) that first used that allocation, or -1 when this one did
};

struct Culled {
    std::uint32_t pass;
    std::string why;          ///< plain words, naming the outputs that nothing reads
    std::uint32_t before = 0; ///< position in CompiledGraph::order of the pass it would have run before
};

struct CompiledGraph {
    std::vector<CompiledPass> order;
    Barrier after = Barrier::None;           ///< after all passes, for the next use of outputs, imports or allocations
    std::vector<ProgramDesc> programs;       ///< of the passes that run, in their order
    std::vector<Culled> culled;              ///< in the order in which they would have run
    std::vector<CompiledResource> resources; ///< parallel to Graph::resources()
    std::vector<ResourceDesc> allocations;   ///< allocations for the backend, by CompiledResource::physical
    std::size_t bytes = 0;                   ///< with aliasing, without imported resources
    std::size_t bytesWithoutAliasing = 0;
};

struct CompileOptions {
    bool cull = true;  ///< off: every pass runs (prune = off)
    bool alias = true; ///< off: transients do not share allocations
};

/// Validates, orders (declaration order wherever data flow allows), culls, computes lifetimes, aliases transients of
/// equal shape and places barriers. Throws GraphError with every fault at once: cycle, stale handle, missing producer,
/// expectation not met, two writers of one version, invalid handle, unfit access, attachments of one pass that differ
/// in size or samples.
CompiledGraph compile(const Graph& graph, const CompileOptions& options = {});

} // namespace tessera::graph
