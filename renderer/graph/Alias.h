#pragma once
#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// Fills first, last and bytes of CompiledGraph::resources from its order. Outputs live to the end of the frame.
void findLifetimes(const Graph& graph, CompiledGraph& compiled);

/// Assigns an allocation to every used transient and sums the bytes. With `alias`, a resource reuses the first
/// allocation of equal shape that is free again; in order of first use this needs the fewest allocations of each shape
/// (interval partitioning: Kleinberg and Tardos 2006, "Algorithm Design", section 4.1). Two resources of one pass never
/// share an allocation, because lifetimes that meet in a pass count as overlapping.
void allocate(const Graph& graph, bool alias, CompiledGraph& compiled);

} // namespace tessera::graph
