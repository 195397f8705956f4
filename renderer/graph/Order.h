#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

struct Ordering {
    std::vector<std::uint32_t> order; ///< passes, without those on a cycle or after one
    std::vector<std::string> cycles;  ///< one line per strongly connected component
};

/// Orders all passes, including those that will be culled, so that culling never changes the order of the others. A
/// pass runs after the writer of each version it reads or modifies, and after every reader of the version it
/// overwrites, since all versions share one memory. Among passes that are ready, the first declared goes first. A pass
/// may read back its own output.
Ordering orderPasses(const Graph& graph, const Flow& flow);

} // namespace tessera::graph
