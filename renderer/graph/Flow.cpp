#include "renderer/graph/Flow.h"

#include <algorithm>

namespace tessera::graph {

Flow::Flow(const Graph& graph) {
    versions_.reserve(graph.resources().size());
    for (const Graph::Resource& resource : graph.resources()) versions_.emplace_back(resource.newestVersion + 1);
    for (std::uint32_t pass = 0; pass < graph.passes().size(); ++pass)
        for (const Graph::Use& use : graph.passes()[pass].uses) {
            if (use.resource >= versions_.size() || use.version >= versions_[use.resource].size()) continue;
            Version& version = versions_[use.resource][use.version];
            if (use.isWrite)
                version.writer = pass;
            else if (version.readers.empty() || version.readers.back() != pass)
                version.readers.push_back(pass);
        }
}

std::optional<std::uint32_t> Flow::writer(std::uint32_t resource, std::uint32_t version) const {
    if (resource >= versions_.size() || version >= versions_[resource].size()) return std::nullopt;
    return versions_[resource][version].writer;
}

std::span<const std::uint32_t> Flow::readers(std::uint32_t resource, std::uint32_t version) const {
    if (resource >= versions_.size() || version >= versions_[resource].size()) return {};
    return versions_[resource][version].readers;
}

void addOnce(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

} // namespace tessera::graph
