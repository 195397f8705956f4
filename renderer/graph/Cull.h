#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/graph/Flow.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// Which passes contribute to a frame output or to a kept pass, by index. The graph must be valid.
std::vector<bool> findNeeded(const Graph& graph, const Flow& flow);

/// Why a pass was culled, in plain words.
std::string whyCulled(const Graph& graph, const Flow& flow, std::uint32_t pass);

} // namespace tessera::graph
