#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/graph/Compile.h"

namespace tessera::graph {

/// The content of `tessera plan`: the passes of a frame, the omitted parts with their reasons, and their bytes. The
/// JSON is the `plan` record of the command line's documentation (schema kPlanSchema).
struct Plan {
    struct Pass {
        std::string name;
        std::vector<std::string> reads;
        std::vector<std::string> writes; ///< created or modified by this pass
        std::optional<double> ms;
        std::string barrier = {}; ///< memory barrier before the pass, in words; empty: none
    };
    struct LeftOut {
        std::string what;
        std::string why;
        std::size_t bytes = 0; ///< saved
        std::optional<double> ms;
        std::vector<std::string> reads = {}; ///< of a pass; empty for anything else
        std::vector<std::string> writes = {};
        std::size_t before = 0; ///< of a pass: index of the pass it would precede
    };
    struct Choice {
        std::string what;
        std::string chosen;
        std::string why;
    };
    struct Resource {
        std::string name;
        std::string format; ///< "buffer" for buffers
        int width = 0;      ///< texels; 0 for buffers
        int height = 0;
        std::optional<std::size_t> bytes; ///< none: known only at execution
        int first = -1;                   ///< index into passes
        int last = -1;
        std::string aliasOf; ///< empty: none
        int samples = 1;
        bool imported = false; ///< not counted in the sums of bytes
    };
    std::string scene;
    std::string technique;
    std::vector<Pass> passes;
    std::vector<LeftOut> leftOut;
    std::vector<Choice> choices;
    std::vector<std::pair<std::string, std::uint64_t>> counters;
    std::vector<Resource> resources;
    std::size_t bytes = 0;
    std::size_t bytesWithoutAliasing = 0;
};
inline constexpr int kPlanSchema = 1;

/// Names in plans, by resource of the graph. Equal names get a number: "blur", "blur (2)".
std::vector<std::string> resourceNames(const Graph& graph);

/// The graph's part of a plan: passes, resources in use, bytes, and the culled passes among leftOut.
Plan makePlan(const Graph& graph, const CompiledGraph& compiled);

std::string planText(const Plan& plan); ///< for people, tables that fit 100 columns
std::string planJson(const Plan& plan); ///< bytes that are not UTF-8 are replaced
std::string planDot(const Plan& plan);  ///< Graphviz: passes as boxes, resources as ellipses, omitted items dashed

/// "512 B", "3.5 MiB", "100 GiB": binary units, one decimal below 100.
std::string readableBytes(std::size_t bytes);

} // namespace tessera::graph
