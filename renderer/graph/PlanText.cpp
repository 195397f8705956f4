#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/graph/Plan.h"
#include "renderer/graph/Table.h"

namespace tessera::graph {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kLongestBar = 24; ///< passes; frames with more show lifetimes as numbers only

using Align = Table::Align;
using Cells = Table::Cells;

std::string milliseconds(const std::optional<double>& ms) {
    return ms ? fmt::format("{:.2f}", *ms) : "-";
}

std::string list(const std::vector<std::string>& names) {
    return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

std::string orDash(const std::string& text) {
    return text.empty() ? "-" : text;
}

std::string headline(const Plan& plan) {
    std::string subject = plan.scene;
    if (!plan.technique.empty()) subject += (subject.empty() ? "" : ", ") + plan.technique;
    const auto count = [](std::size_t number, const char* one, const char* many) {
        return fmt::format("{} {}", number, number == 1 ? one : many);
    };
    return fmt::format("{}{} {}, {} left out", subject.empty() ? "" : subject + ": ",
                       count(plan.passes.size(), "pass", "passes"), plan.passes.size() == 1 ? "runs" : "run",
                       count(plan.leftOut.size(), "thing", "things"));
}

std::string runs(const Plan& plan) {
    const auto any = [&](auto&& has) { return std::any_of(plan.passes.begin(), plan.passes.end(), has); };
    const bool hasBarriers = any([](const Plan::Pass& pass) { return !pass.barrier.empty(); });
    const bool hasTimes = any([](const Plan::Pass& pass) { return pass.ms.has_value(); });
    Table table(kWidth);
    table.addColumn("#", Align::Right, Cells::Whole);
    table.addColumn("pass");
    table.addColumn("reads");
    table.addColumn("writes");
    if (hasBarriers) table.addColumn("barrier before");
    if (hasTimes) table.addColumn("ms", Align::Right, Cells::Whole);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Plan::Pass& pass = plan.passes[i];
        std::vector<std::string> cells{std::to_string(i), pass.name, list(pass.reads), list(pass.writes)};
        if (hasBarriers) cells.push_back(orDash(pass.barrier));
        if (hasTimes) cells.push_back(milliseconds(pass.ms));
        table.addRow(std::move(cells));
    }
    return table.text();
}

std::string leftOut(const Plan& plan) {
    const bool hasTimes = std::any_of(plan.leftOut.begin(), plan.leftOut.end(),
                                      [](const Plan::LeftOut& item) { return item.ms.has_value(); });
    Table table(kWidth);
    table.addColumn("what");
    table.addColumn("why");
    table.addColumn("saves", Align::Right, Cells::Whole);
    if (hasTimes) table.addColumn("ms", Align::Right, Cells::Whole);
    for (const Plan::LeftOut& item : plan.leftOut) {
        std::vector<std::string> cells{item.what, item.why, item.bytes == 0 ? "-" : readableBytes(item.bytes)};
        if (hasTimes) cells.push_back(milliseconds(item.ms));
        table.addRow(std::move(cells));
    }
    return table.text();
}

std::string choices(const Plan& plan) {
    Table table(kWidth);
    table.addColumn("what");
    table.addColumn("chosen");
    table.addColumn("why");
    for (const Plan::Choice& choice : plan.choices) table.addRow({choice.what, choice.chosen, choice.why});
    return table.text();
}

std::string sizeOf(const Plan::Resource& resource) {
    if (resource.width == 0) return "-";
    const std::string size = fmt::format("{} x {}", resource.width, resource.height);
    return resource.samples == 1 ? size : fmt::format("{} x{}", size, resource.samples);
}

/// "1-3", with a bar over all passes.
std::string lifetime(const Plan::Resource& resource, std::size_t passes) {
    const std::size_t digits = std::to_string(passes).size();
    const std::string numbers = fmt::format("{:>{}}-{:<{}}", resource.first, digits, resource.last, digits);
    if (passes > kLongestBar) return numbers;
    std::string bar(passes, '.');
    for (int i = std::max(resource.first, 0); i <= resource.last && i < int(passes); ++i) bar[std::size_t(i)] = '#';
    return numbers + " " + bar;
}

std::string resources(const Plan& plan) {
    Table table(kWidth);
    table.addColumn("name");
    table.addColumn("format");
    table.addColumn("size", Align::Left, Cells::Whole);
    table.addColumn("memory", Align::Right, Cells::Whole);
    table.addColumn("lives", Align::Left, Cells::Whole);
    table.addColumn("in the memory of");
    for (const Plan::Resource& resource : plan.resources)
        table.addRow({resource.name, resource.format, sizeOf(resource),
                      resource.bytes      ? readableBytes(*resource.bytes)
                      : resource.imported ? "-"
                                          : "as counted",
                      lifetime(resource, plan.passes.size()),
                      resource.imported ? "(imported)" : orDash(resource.aliasOf)});
    return table.text();
}

std::string counters(const Plan& plan) {
    Table table(kWidth);
    table.addColumn("counter");
    table.addColumn("value", Align::Right, Cells::Whole);
    for (const auto& [name, value] : plan.counters) table.addRow({name, std::to_string(value)});
    return table.text();
}

} // namespace

std::string planText(const Plan& plan) {
    std::string text;
    for (const std::string& line : wrapText(headline(plan), kWidth)) text += line + "\n";
    text += fmt::format("{} of memory, {} without aliasing\n", readableBytes(plan.bytes),
                        readableBytes(plan.bytesWithoutAliasing));
    const auto section = [&](const char* title, bool empty, const std::string& table) {
        if (!empty) text += fmt::format("\n{}\n{}", title, table);
    };
    section("Runs, in this order", plan.passes.empty(), runs(plan));
    section("Left out", plan.leftOut.empty(), leftOut(plan));
    section("Choices", plan.choices.empty(), choices(plan));
    section("Resources", plan.resources.empty(), resources(plan));
    section("Counters", plan.counters.empty(), counters(plan));
    return text;
}

} // namespace tessera::graph
