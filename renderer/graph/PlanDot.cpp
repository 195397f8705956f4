#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

#include "renderer/graph/Plan.h"
#include "renderer/graph/Table.h"

namespace tessera::graph {
namespace {

constexpr std::size_t kNoteWidth = 34; ///< characters per line of explanations

/// Tints of aliased memory, in order of appearance; far apart in hue and light enough for black text.
constexpr std::array kSharedTints{"#f6c28b", "#9fd8cb", "#c9b6e4", "#f4a9a8",
                                  "#b5d99c", "#9cc3e6", "#f0df8c", "#e3b7cf"};

constexpr const char* kHead = R"(digraph frame {
  rankdir=LR; nodesep=0.28; ranksep=0.55; bgcolor="white"; labelloc=t; fontname="Helvetica"; fontsize=16;
  node [fontname="Helvetica", fontsize=11, margin="0.12,0.07", color="#24405c"];
  edge [color="#5b6770", arrowsize=0.7];
)";
constexpr const char* kPassStyle = R"(shape=box, style="rounded,filled", fillcolor="#24405c", fontcolor="white")";
constexpr const char* kLeftOutStyle = R"(style=dashed, color="#9aa3ab", fontcolor="#7b848c")";

std::string escape(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '>')
            escaped += "&gt;";
        else if (c == '"')
            escaped += "&quot;";
        else
            escaped += c;
    }
    return escaped;
}

/// A label: a bold title and smaller lines below.
std::string label(const std::string& title, const std::vector<std::string>& lines) {
    std::string text = fmt::format("label=<<B>{}</B>", escape(title));
    for (const std::string& line : lines) text += fmt::format("<BR/><FONT POINT-SIZE=\"9\">{}</FONT>", escape(line));
    return text + ">";
}

/// Draws the data flow in the order of execution. Each version of a resource is a separate ellipse, so that a pass that
/// modifies a resource stands between two of them and arrows never point backwards.
class Drawing {
public:
    explicit Drawing(const Plan& plan) : plan_(plan) {
        std::map<std::string, int> tenants;
        for (const Plan::Resource& resource : plan.resources) ++tenants[ownerOf(resource)];
        for (const Plan::Resource& resource : plan.resources)
            if (tenants[ownerOf(resource)] > 1) tints_.try_emplace(ownerOf(resource), tints_.size());
    }

    std::string draw() {
        std::string title = plan_.scene;
        if (!plan_.technique.empty()) title += (title.empty() ? "" : ", ") + plan_.technique;
        std::vector<std::string> lines{fmt::format("{} of memory, {} without aliasing", readableBytes(plan_.bytes),
                                                   readableBytes(plan_.bytesWithoutAliasing))};
        if (!tints_.empty()) lines.push_back("resources of one tint share their memory");
        text_ = kHead + fmt::format("  {};\n", label(title.empty() ? "frame" : title, lines));
        for (std::size_t i = 0; i <= plan_.passes.size(); ++i) {
            for (std::size_t j = 0; j < plan_.leftOut.size(); ++j)
                if (isPass(plan_.leftOut[j]) && std::min(plan_.leftOut[j].before, plan_.passes.size()) == i)
                    addLeftOutPass(j);
            if (i < plan_.passes.size()) addPass(i);
        }
        addNotes();
        return text_ + "}\n";
    }

private:
    static bool isPass(const Plan::LeftOut& item) { return !item.reads.empty() || !item.writes.empty(); }
    static const std::string& ownerOf(const Plan::Resource& resource) {
        return resource.aliasOf.empty() ? resource.name : resource.aliasOf;
    }

    void addPass(std::size_t index) {
        const Plan::Pass& pass = plan_.passes[index];
        const std::string node = fmt::format("pass{}", index);
        std::vector<std::string> lines;
        if (pass.ms) lines.push_back(fmt::format("{:.2f} ms", *pass.ms));
        if (!pass.barrier.empty()) lines.push_back("barrier: " + pass.barrier);
        text_ += fmt::format("  {} [{}, {}];\n", node, label(pass.name, lines), kPassStyle);
        connect(node, pass.reads, pass.writes, false);
    }

    void addLeftOutPass(std::size_t index) {
        const Plan::LeftOut& item = plan_.leftOut[index];
        const std::string node = fmt::format("leftOut{}", index);
        text_ += fmt::format("  {} [{}, shape=box, {}];\n", node, label(item.what, wrapText(item.why, kNoteWidth)),
                             kLeftOutStyle);
        connect(node, item.reads, item.writes, true);
    }

    void connect(const std::string& node, const std::vector<std::string>& reads, const std::vector<std::string>& writes,
                 bool isLeftOut) {
        std::set<std::string> sources;
        for (const std::string& name : reads) sources.insert(newestVersion(name, isLeftOut));
        for (const std::string& name : writes) sources.insert(newestVersion(name, isLeftOut));
        for (const std::string& source : sources)
            if (!source.empty()) addEdge(source, node, isLeftOut);
        for (const std::string& name : writes) addEdge(node, addVersion(name, isLeftOut), isLeftOut);
    }

    void addEdge(const std::string& from, const std::string& to, bool isLeftOut) {
        text_ += fmt::format("  {} -> {}{};\n", from, to, isLeftOut ? R"( [style=dashed, color="#b4bcc2"])" : "");
    }

    /// The node of a resource's current version; empty for a resource without contents yet.
    std::string newestVersion(const std::string& name, bool isLeftOut) {
        if (const auto leftOut = leftOutVersions_.find(name); isLeftOut && leftOut != leftOutVersions_.end())
            return leftOut->second;
        if (const auto version = versions_.find(name); version != versions_.end()) return version->second;
        const Plan::Resource* resource = find(name);
        return resource && resource->imported ? addVersion(name, false) : "";
    }

    std::string addVersion(const std::string& name, bool isLeftOut) {
        const std::string node = fmt::format("resource{}", ++nodes_);
        (isLeftOut ? leftOutVersions_ : versions_)[name] = node;
        const Plan::Resource* resource = find(name);
        if (isLeftOut || !resource) {
            text_ += fmt::format("  {} [{}, shape=ellipse, {}];\n", node, label(name, {}), kLeftOutStyle);
            return node;
        }
        const auto tint = tints_.find(ownerOf(*resource));
        text_ += fmt::format("  {} [{}, shape=ellipse, style=filled, fillcolor=\"{}\"];\n", node,
                             label(name, describe(*resource)),
                             tint == tints_.end() ? "#eef2f5" : kSharedTints[tint->second % kSharedTints.size()]);
        return node;
    }

    static std::vector<std::string> describe(const Plan::Resource& resource) {
        std::string shape = resource.format;
        if (resource.width > 0) shape += fmt::format(" {} x {}", resource.width, resource.height);
        if (resource.samples != 1) shape += fmt::format(" x{}", resource.samples);
        return {shape, (resource.bytes      ? readableBytes(*resource.bytes) + (resource.imported ? ", imported" : "")
                        : resource.imported ? "imported"
                                            : "as counted")};
    }

    const Plan::Resource* find(const std::string& name) const {
        const auto found = std::find_if(plan_.resources.begin(), plan_.resources.end(),
                                        [&](const Plan::Resource& resource) { return resource.name == name; });
        return found == plan_.resources.end() ? nullptr : &*found;
    }

    /// Adds omitted items that are not part of the data flow.
    void addNotes() {
        std::string notes;
        for (std::size_t i = 0; i < plan_.leftOut.size(); ++i) {
            const Plan::LeftOut& item = plan_.leftOut[i];
            if (!isPass(item))
                notes += fmt::format("    leftOut{} [{}, shape=note, {}];\n", i,
                                     label(item.what, wrapText(item.why, kNoteWidth)), kLeftOutStyle);
        }
        if (!notes.empty())
            text_ += fmt::format("  subgraph cluster_leftOut {{\n    label=\"left out\"; fontsize=11; {};\n{}  }}\n",
                                 R"(style="rounded,dashed"; color="#c5ccd2"; fontcolor="#7b848c")", notes);
    }

    const Plan& plan_;
    std::string text_;
    std::map<std::string, std::size_t> tints_;           ///< by the owner of shared memory
    std::map<std::string, std::string> versions_;        ///< newest node of a resource
    std::map<std::string, std::string> leftOutVersions_; ///< the same for culled passes
    int nodes_ = 0;
};

} // namespace

std::string planDot(const Plan& plan) {
    return Drawing(plan).draw();
}

} // namespace tessera::graph
