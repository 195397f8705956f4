#include "renderer/graph/Compile.h"

#include "renderer/graph/Alias.h"
#include "renderer/graph/Barriers.h"
#include "renderer/graph/Cull.h"
#include "renderer/graph/Order.h"
#include "renderer/graph/Validate.h"

namespace tessera::graph {

CompiledGraph compile(const Graph& graph, const CompileOptions& options) {
    const Flow flow(graph);
    std::vector<std::string> faults = findFaults(graph, flow);
    Ordering ordering = orderPasses(graph, flow);
    faults.insert(faults.end(), ordering.cycles.begin(), ordering.cycles.end());
    if (!faults.empty()) throw GraphError(std::move(faults));

    CompiledGraph compiled;
    const std::vector<bool> needed = findNeeded(graph, flow);
    for (const std::uint32_t pass : ordering.order)
        if (needed[pass] || !options.cull)
            compiled.order.push_back({.pass = pass});
        else
            compiled.culled.push_back(
                {.pass = pass, .why = whyCulled(graph, flow, pass), .before = std::uint32_t(compiled.order.size())});
    for (const CompiledPass& entry : compiled.order) {
        const std::vector<ProgramDesc>& programs = graph.passes()[entry.pass].programs;
        compiled.programs.insert(compiled.programs.end(), programs.begin(), programs.end());
    }
    findLifetimes(graph, compiled);
    allocate(graph, options.alias, compiled);
    placeBarriers(graph, compiled);
    return compiled;
}

} // namespace tessera::graph
