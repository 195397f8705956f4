#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

struct Ordering {
    std::vector<std::uint32_t> order; ///< passes; those on a cycle, or behind one, are missing
    std::vector<std::string> cycles;  ///< one line for each knot of passes that wait for each other
};

/// Orders all passes, also those that culling leaves out, so that culling never changes the order of the others.
/// A pass runs after the writer of each version it reads or adds to, and after every reader of the version it writes
/// over, since all versions share one memory. Among passes that are free to run, the first declared goes first.
/// A pass may read back what it wrote itself.
Ordering orderPasses(const Graph& graph, const Flow& flow);

} // namespace tessera::graph
