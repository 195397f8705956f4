#pragma once
#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// Fills first, last and bytes of CompiledGraph::resources from its order. Outputs live to the end of the frame.
void findLifetimes(const Graph& graph, CompiledGraph& compiled);

/// Gives every used transient an allocation and sums the bytes. With `alias`, a resource moves into the first
/// allocation of equal shape that is no longer in use; taken in order of first use this needs the least allocations of
/// each shape (interval partitioning: Kleinberg and Tardos 2006, "Algorithm Design", section 4.1). A pass that uses two
/// resources always finds them in two allocations, because lifetimes that touch in one pass count as overlapping.
void allocate(const Graph& graph, bool alias, CompiledGraph& compiled);

} // namespace tessera::graph
