#include "renderer/graph/Order.h"

#include <algorithm>
#include <functional>
#include <queue>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tessera::graph {
namespace {

enum class Reason : std::uint8_t { Reads, AddsTo, WritesOver };

/// `to` must run after `from`.
struct Edge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t resource;
    std::uint32_t version;
    Reason reason;
};

std::vector<Edge> findEdges(const Graph& graph, const Flow& flow) {
    std::vector<Edge> edges;
    const auto add = [&](std::uint32_t from, std::uint32_t to, const Graph::Use& use, std::uint32_t version,
                         Reason reason) {
        if (from != to) edges.push_back({from, to, use.resource, version, reason});
    };
    for (std::uint32_t pass = 0; pass < graph.passes().size(); ++pass)
        for (const Graph::Use& use : graph.passes()[pass].uses) {
            const std::uint32_t needed = use.isWrite ? use.version - 1 : use.version;
            if (use.resource >= graph.resources().size()) continue;
            if (const auto writer = flow.writer(use.resource, needed))
                add(*writer, pass, use, needed, use.isWrite ? Reason::AddsTo : Reason::Reads);
            if (!use.isWrite) continue;
            for (const std::uint32_t reader : flow.readers(use.resource, needed))
                add(reader, pass, use, needed, Reason::WritesOver);
        }
    return edges;
}

std::string describe(const Graph& graph, const Edge& edge) {
    const std::string& from = graph.passes()[edge.from].name;
    const std::string& to = graph.passes()[edge.to].name;
    const std::string& resource = graph.resources()[edge.resource].name;
    switch (edge.reason) {
    case Reason::Reads:
        return fmt::format("'{}' reads '{}' from '{}'", to, resource, from);
    case Reason::AddsTo:
        return fmt::format("'{}' adds to '{}' from '{}'", to, resource, from);
    case Reason::WritesOver:
        break;
    }
    return fmt::format("'{}' writes over version {} of '{}', which '{}' reads", to, edge.version, resource, from);
}

/// Finds cycles among passes that could not be ordered: one, as short as possible, per strongly connected component.
class CycleFinder {
public:
    CycleFinder(const Graph& graph, const std::vector<Edge>& edges, const std::vector<bool>& ordered)
        : graph_(graph), outgoing_(ordered.size()), incoming_(ordered.size()), done_(ordered) {
        for (const Edge& edge : edges)
            if (!ordered[edge.from] && !ordered[edge.to]) {
                outgoing_[edge.from].push_back(edge);
                incoming_[edge.to].push_back({edge.to, edge.from, edge.resource, edge.version, edge.reason});
            }
    }

    std::vector<std::string> find() {
        std::vector<std::string> cycles;
        for (std::uint32_t start = 0; start < done_.size(); ++start) {
            if (done_[start]) continue;
            const auto forward = arrivals(start, outgoing_);
            if (!forward[start]) continue; // waits for a cycle, but is not part of one
            const auto backward = arrivals(start, incoming_);
            for (std::uint32_t pass = 0; pass < done_.size(); ++pass)
                if (forward[pass] && backward[pass]) done_[pass] = true;
            cycles.push_back(describeCycle(start, forward));
        }
        return cycles;
    }

private:
    using Arrivals = std::vector<const Edge*>; ///< the edge by which a breadth-first search first reached each pass

    static Arrivals arrivals(std::uint32_t start, const std::vector<std::vector<Edge>>& edges) {
        Arrivals reachedBy(edges.size(), nullptr);
        std::queue<std::uint32_t> open({start});
        for (; !open.empty(); open.pop())
            for (const Edge& edge : edges[open.front()])
                if (!reachedBy[edge.to]) {
                    reachedBy[edge.to] = &edge;
                    open.push(edge.to);
                }
        return reachedBy;
    }

    std::string describeCycle(std::uint32_t start, const Arrivals& reachedBy) const {
        std::vector<const Edge*> path;
        std::uint32_t at = start;
        do {
            path.push_back(reachedBy[at]);
            at = path.back()->from;
        } while (at != start);
        std::reverse(path.begin(), path.end());
        std::vector<std::string> names;
        std::vector<std::string> steps;
        for (const Edge* edge : path) {
            names.push_back(fmt::format("'{}'", graph_.passes()[edge->from].name));
            steps.push_back(describe(graph_, *edge));
        }
        return fmt::format("passes {} wait for each other in a cycle: {}", fmt::join(names, ", "),
                           fmt::join(steps, "; "));
    }

    const Graph& graph_;
    std::vector<std::vector<Edge>> outgoing_;
    std::vector<std::vector<Edge>> incoming_; ///< reversed: to is the pass that must run earlier
    std::vector<bool> done_;
};

} // namespace

Ordering orderPasses(const Graph& graph, const Flow& flow) {
    const std::vector<Edge> edges = findEdges(graph, flow);
    std::vector<std::vector<std::uint32_t>> followers(graph.passes().size());
    std::vector<std::uint32_t> waitsFor(graph.passes().size(), 0);
    for (const Edge& edge : edges) {
        followers[edge.from].push_back(edge.to);
        ++waitsFor[edge.to];
    }
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> free;
    for (std::uint32_t pass = 0; pass < waitsFor.size(); ++pass)
        if (waitsFor[pass] == 0) free.push(pass);

    Ordering result;
    std::vector<bool> ordered(graph.passes().size(), false);
    while (!free.empty()) {
        const std::uint32_t pass = free.top();
        free.pop();
        ordered[pass] = true;
        result.order.push_back(pass);
        for (const std::uint32_t follower : followers[pass])
            if (--waitsFor[follower] == 0) free.push(follower);
    }
    if (result.order.size() < graph.passes().size()) result.cycles = CycleFinder(graph, edges, ordered).find();
    return result;
}

} // namespace tessera::graph
