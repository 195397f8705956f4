#pragma once
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// Finds all faults of the declaration except cycles (Order.h), one line each with pass and resource, in declaration
/// order. Passes that will be culled are checked too, so that a frame's options never hide a fault.
std::vector<std::string> findFaults(const Graph& graph, const Flow& flow);

} // namespace tessera::graph
