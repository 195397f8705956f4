#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// Which passes lead to an output of the frame or to a kept pass, by index; the graph must be without faults.
std::vector<bool> findNeeded(const Graph& graph, const Flow& flow);

/// Why a pass is not among the needed ones, in plain words.
std::string whyCulled(const Graph& graph, const Flow& flow, std::uint32_t pass);

} // namespace tessera::graph
