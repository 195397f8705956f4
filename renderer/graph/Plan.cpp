#include "renderer/graph/Plan.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "renderer/graph/Access.h"
#include "renderer/graph/Flow.h"

namespace tessera::graph {
namespace {

/// The inputs of a pass, without resources that it only reads back from itself.
std::vector<std::string> readsOf(const Graph::Pass& pass, const std::vector<std::string>& names) {
    std::vector<std::string> reads;
    for (const Graph::Use& use : pass.uses) {
        const bool madeHere = std::any_of(pass.uses.begin(), pass.uses.end(), [&](const Graph::Use& other) {
            return other.isWrite && other.resource == use.resource && other.version == use.version;
        });
        if (!use.isWrite && !madeHere) addOnce(reads, names[use.resource]);
    }
    return reads;
}

std::vector<std::string> writesOf(const Graph::Pass& pass, const std::vector<std::string>& names) {
    std::vector<std::string> writes;
    for (const Graph::Use& use : pass.uses)
        if (use.isWrite) addOnce(writes, names[use.resource]);
    return writes;
}

/// Bytes of the transients that a culled pass would create. Remaining passes use none of them.
std::size_t bytesSaved(const Graph& graph, const Graph::Pass& pass) {
    std::size_t bytes = 0;
    for (const Graph::Use& use : pass.uses) {
        const Graph::Resource& resource = graph.resources()[use.resource];
        if (use.isWrite && use.version == 1 && !resource.imported) bytes += descBytes(resource.desc);
    }
    return bytes;
}

Plan::Resource describe(const Graph::Resource& resource, const CompiledResource& compiled,
                        const std::vector<std::string>& names) {
    Plan::Resource described;
    described.name = names[compiled.resource];
    described.format = "buffer";
    if (const auto* texture = std::get_if<TextureDesc>(&resource.desc)) {
        described.format = formatInfo(texture->format).name;
        described.width = texture->width;
        described.height = texture->height;
        described.samples = texture->samples;
    }
    if (compiled.bytes > 0) described.bytes = compiled.bytes;
    described.first = compiled.first;
    described.last = compiled.last;
    if (compiled.aliasOf >= 0) described.aliasOf = names[std::size_t(compiled.aliasOf)];
    described.imported = resource.imported;
    return described;
}

} // namespace

std::vector<std::string> resourceNames(const Graph& graph) {
    std::map<std::string, int> seen;
    std::vector<std::string> names;
    for (const Graph::Resource& resource : graph.resources()) {
        const int count = ++seen[resource.name];
        names.push_back(count == 1 ? resource.name : fmt::format("{} ({})", resource.name, count));
    }
    return names;
}

Plan makePlan(const Graph& graph, const CompiledGraph& compiled) {
    const std::vector<std::string> names = resourceNames(graph);
    Plan plan;
    for (const CompiledPass& entry : compiled.order) {
        const Graph::Pass& pass = graph.passes()[entry.pass];
        plan.passes.push_back({.name = pass.name,
                               .reads = readsOf(pass, names),
                               .writes = writesOf(pass, names),
                               .ms = std::nullopt,
                               .barrier = describeBarrier(entry.before)});
    }
    for (const Culled& culled : compiled.culled) {
        const Graph::Pass& pass = graph.passes()[culled.pass];
        plan.leftOut.push_back({.what = "pass " + pass.name,
                                .why = culled.why,
                                .bytes = bytesSaved(graph, pass),
                                .ms = std::nullopt,
                                .reads = readsOf(pass, names),
                                .writes = writesOf(pass, names),
                                .before = culled.before});
    }
    for (const CompiledResource& resource : compiled.resources)
        if (resource.first >= 0)
            plan.resources.push_back(describe(graph.resources()[resource.resource], resource, names));
    plan.bytes = compiled.bytes;
    plan.bytesWithoutAliasing = compiled.bytesWithoutAliasing;
    return plan;
}

std::string readableBytes(std::size_t bytes) {
    static constexpr std::array<const char*, 5> kUnits{"B", "KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes);
    std::size_t unit = 0;
    // Moves to the next unit already where rounding to whole numbers would print 1024.
    while (value >= 1023.5 && unit + 1 < kUnits.size()) {
        value /= 1024.0;
        ++unit;
    }
    return unit == 0 || value >= 99.95 ? fmt::format("{:.0f} {}", value, kUnits[unit])
                                       : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

} // namespace tessera::graph
