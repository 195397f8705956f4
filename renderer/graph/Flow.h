#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// The writer and the readers of each version of each resource. Ignores uses of invalid handles, so that faulty graphs
/// can be analysed too.
class Flow {
public:
    explicit Flow(const Graph& graph);
    /// The pass whose write made this version; none for version 0 and for versions that do not exist.
    std::optional<std::uint32_t> writer(std::uint32_t resource, std::uint32_t version) const;
    /// The passes that read this version, in declaration order, each once.
    std::span<const std::uint32_t> readers(std::uint32_t resource, std::uint32_t version) const;

private:
    struct Version {
        std::optional<std::uint32_t> writer;
        std::vector<std::uint32_t> readers;
    };
    std::vector<std::vector<Version>> versions_; ///< [resource][version]
};

/// Appends a name unless the list contains it.
void addOnce(std::vector<std::string>& names, const std::string& name);

} // namespace tessera::graph
