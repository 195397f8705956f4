#include "renderer/graph/Alias.h"

#include <algorithm>

namespace tessera::graph {

void findLifetimes(const Graph& graph, CompiledGraph& compiled) {
    compiled.resources.clear();
    for (std::uint32_t i = 0; i < graph.resources().size(); ++i)
        compiled.resources.push_back({.resource = i, .bytes = descBytes(graph.resources()[i].desc)});
    for (int position = 0; position < int(compiled.order.size()); ++position)
        for (const Graph::Use& use : graph.passes()[compiled.order[std::size_t(position)].pass].uses) {
            CompiledResource& resource = compiled.resources[use.resource];
            if (resource.first < 0) resource.first = position;
            resource.last = position;
        }
    for (const Graph::Use& output : graph.outputs()) {
        CompiledResource& resource = compiled.resources[output.resource];
        if (resource.first >= 0) resource.last = int(compiled.order.size()) - 1;
    }
}

void allocate(const Graph& graph, bool alias, CompiledGraph& compiled) {
    std::vector<CompiledResource*> byFirstUse;
    for (CompiledResource& resource : compiled.resources)
        if (resource.first >= 0 && !graph.resources()[resource.resource].imported) byFirstUse.push_back(&resource);
    std::stable_sort(byFirstUse.begin(), byFirstUse.end(),
                     [](const CompiledResource* a, const CompiledResource* b) { return a->first < b->first; });

    struct Tenancy {
        int owner; ///< the resource that used the allocation first
        int last;  ///< position of its last use so far
    };
    std::vector<Tenancy> tenancies; // parallel to CompiledGraph::allocations
    for (CompiledResource* resource : byFirstUse) {
        const ResourceDesc& desc = graph.resources()[resource->resource].desc;
        compiled.bytesWithoutAliasing += resource->bytes;
        if (const auto* buffer = std::get_if<BufferDesc>(&desc); buffer && buffer->grows) { // has dedicated memory
            compiled.bytes += resource->bytes;
            continue;
        }
        std::size_t slot = alias ? 0 : tenancies.size();
        while (slot < tenancies.size() &&
               (tenancies[slot].last >= resource->first || compiled.allocations[slot] != desc))
            ++slot;
        if (slot == tenancies.size()) {
            tenancies.push_back({int(resource->resource), resource->last});
            compiled.allocations.push_back(desc);
            compiled.bytes += resource->bytes;
        } else {
            resource->aliasOf = tenancies[slot].owner;
            tenancies[slot].last = resource->last;
        }
        resource->physical = int(slot);
    }
}

} // namespace tessera::graph
