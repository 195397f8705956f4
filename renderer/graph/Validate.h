#pragma once
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// Every fault of the declaration but cycles (see Order.h), each one line that names pass and resource, in declaration
/// order. Passes that culling would leave out are checked too, so that a frame's options never hide a fault.
std::vector<std::string> findFaults(const Graph& graph, const Flow& flow);

} // namespace tessera::graph
