#include "renderer/graph/ProgramDesc.h"

#include <algorithm>

#include <fmt/format.h>

namespace tessera::graph {

std::string ProgramDesc::key() const {
    std::string text = fmt::format("{}|{}|{}|{}|{}|", name, vertex, fragment, compute, geometry);
    Defines sorted = defines;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        text += fmt::format("{}{}={}", i == 0 ? "" : ";", sorted[i].first, sorted[i].second);
    return text;
}

} // namespace tessera::graph
