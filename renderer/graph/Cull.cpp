#include "renderer/graph/Cull.h"

#include <algorithm>

#include <fmt/format.h>

namespace tessera::graph {
namespace {

/// "'a'", "'a' and 'b'", "'a', 'b' and 'c'" with the conjunction given.
std::string listNames(const std::vector<std::string>& names, std::string_view conjunction) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", conjunction) : ", ";
        text += fmt::format("'{}'", names[i]);
    }
    return text;
}

/// The passes that use the version that a write produces: its readers, and the pass that writes the next version.
std::vector<std::string> usersOf(const Graph& graph, const Flow& flow, std::uint32_t pass, const Graph::Use& use) {
    std::vector<std::string> users;
    for (const std::uint32_t reader : flow.readers(use.resource, use.version))
        if (reader != pass) addOnce(users, graph.passes()[reader].name);
    const auto next = flow.writer(use.resource, use.version + 1);
    if (next && *next != pass) addOnce(users, graph.passes()[*next].name);
    return users;
}

} // namespace

std::vector<bool> findNeeded(const Graph& graph, const Flow& flow) {
    std::vector<bool> needed(graph.passes().size(), false);
    std::vector<std::uint32_t> open;
    const auto need = [&](std::uint32_t pass) {
        if (!needed[pass]) open.push_back(pass);
        needed[pass] = true;
    };
    for (const Graph::Use& output : graph.outputs())
        if (const auto writer = flow.writer(output.resource, output.version)) need(*writer);
    for (std::uint32_t pass = 0; pass < needed.size(); ++pass)
        if (graph.passes()[pass].keep) need(pass);
    while (!open.empty()) {
        const Graph::Pass& pass = graph.passes()[open.back()];
        open.pop_back();
        for (const Graph::Use& use : pass.uses)
            if (const auto writer = flow.writer(use.resource, use.isWrite ? use.version - 1 : use.version))
                need(*writer);
    }
    return needed;
}

std::string whyCulled(const Graph& graph, const Flow& flow, std::uint32_t pass) {
    std::vector<std::string> unread;
    std::vector<std::string> reasons;
    bool writes = false;
    for (const Graph::Use& use : graph.passes()[pass].uses) {
        if (!use.isWrite) continue;
        writes = true;
        const std::string& name = graph.resources()[use.resource].name;
        const std::vector<std::string> users = usersOf(graph, flow, pass, use);
        if (users.empty())
            addOnce(unread, name);
        else
            addOnce(reasons, fmt::format("'{}' is used only by {}, left out as well", name, listNames(users, "and")));
    }
    if (!writes) return "it writes nothing and is not kept";
    if (!unread.empty()) reasons.insert(reasons.begin(), fmt::format("nothing needs {}", listNames(unread, "or")));
    std::string why;
    for (const std::string& reason : reasons) why += (why.empty() ? "" : "; ") + reason;
    return why;
}

} // namespace tessera::graph
