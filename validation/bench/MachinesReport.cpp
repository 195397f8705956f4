#include <algorithm>

#include <fmt/format.h>

#include "validation/bench/BenchMachines.h"
#include "validation/bench/Recommend.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Html.h"

namespace tessera::validation {

namespace {

constexpr const char* kHowToReadMachines =
    "<p class=\"lede\">A column is a machine. The factor beside a time is that time over the one of the machine's "
    "fastest point in the group: it compares points within a machine. Times of different machines say which machine "
    "is faster, and nothing of the techniques. In bold is what is recommended on that machine.</p>\n";

std::string machineTitle(std::size_t machine) {
    return fmt::format("Machine {}", machine + 1);
}

/// A table of the machines, with links to their pages.
std::string machinesHtml(std::span<const MachineBench> machines) {
    std::string html = "<section id=\"machines\">\n<h2>The machines</h2>\n<table>\n<thead><tr>";
    for (const char* title : {"Machine", "Processor and system", "Renderer", "OpenGL", "Points", "What to take"})
        html += fmt::format("<th scope=\"col\">{}</th>", title);
    html += "</tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < machines.size(); ++i) {
        const BenchRecord& record = machines[i].record;
        std::size_t points = 0;
        for (const BenchGroup& group : record.groups) points += group.results.size();
        html += fmt::format("<tr><th scope=\"row\"><a href=\"{}/report.html\">{}</a></th>\n",
                            escapedHtml(machines[i].folder), machineTitle(i));
        const auto add = [&html](const char* label, const std::string& text) {
            html += fmt::format("<td data-label=\"{}\"><span>{}</span></td>\n", label, escapedHtml(text));
        };
        add("Processor and system", record.machine);
        add("Renderer", record.renderer);
        add("OpenGL", record.driver);
        add("Points", fmt::format("{} of {}", points, record.plannedPoints));
        add("What to take", recommendationText(record.groups));
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table>\n</section>\n";
}

std::string machineCellHtml(const std::optional<MachineCell>& cell) {
    if (!cell) return "&ndash;";
    const std::optional<BenchError>& error = cell->result->error;
    const std::string time =
        fmt::format("{:.1f} ms, {:.2f}&times;", cell->result->times.cpuMs.median, cell->timesFastest);
    return fmt::format("{}<span class=\"reason\">relMSE {}</span>",
                       cell->isRecommended ? "<strong>" + time + "</strong>" : time,
                       figureHtml(error ? error->relMse : std::nullopt));
}

std::string machineGroupHtml(const MachineGroup& group) {
    std::string html = fmt::format("<h3>{}</h3>\n<table>\n<thead><tr><th scope=\"col\">Point</th>",
                                   escapedHtml(groupName(*group.group)));
    for (std::size_t i = 0; i < group.rows.front().cells.size(); ++i)
        html += fmt::format("<th scope=\"col\">{}</th>", machineTitle(i));
    html += "</tr></thead>\n<tbody>\n";
    for (const MachineRow& row : group.rows) {
        html += fmt::format("<tr><th scope=\"row\">{}</th>\n", escapedHtml(row.point));
        for (std::size_t i = 0; i < row.cells.size(); ++i)
            html += fmt::format("<td class=\"number\" data-label=\"{}\"><span>{}</span></td>\n", machineTitle(i),
                                machineCellHtml(row.cells[i]));
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table>\n";
}

} // namespace

Report machinesReport(std::span<const MachineBench> machines) {
    Report report;
    std::vector<std::string> renderers;
    for (const MachineBench& machine : machines) {
        const BenchRecord& record = machine.record;
        if (std::ranges::find(renderers, record.renderer) == renderers.end()) renderers.push_back(record.renderer);
        if (std::ranges::find(report.commands, record.command) == report.commands.end())
            report.commands.push_back(record.command);
    }
    const std::vector<MachineGroup> groups = machineGroups(machines);
    const bool isOneScene = std::ranges::all_of(
        groups, [&](const MachineGroup& group) { return group.group->scene == groups.front().group->scene; });
    report.title = fmt::format("{} on {} machines",
                               isOneScene && !groups.empty() ? groups.front().group->scene : std::string("Scenes"),
                               machines.size());
    report.record.renderer = fmt::format("{}", fmt::join(renderers, "; "));
    std::size_t points = 0;
    std::string html = machinesHtml(machines) + "<section id=\"points\">\n<h2>Every point</h2>\n" + kHowToReadMachines;
    for (const MachineGroup& group : groups) {
        points += group.rows.size();
        html += machineGroupHtml(group);
    }
    report.facts = {{"Machines", fmt::format("{}", machines.size())},
                    {"Points", fmt::format("{}", points)},
                    {"Frames of each", fmt::format("{}", machines.front().record.frames)},
                    {"Commit", machines.front().record.commit}};
    report.bench = ReportBench{"", html + "</section>\n"};
    return report;
}

} // namespace tessera::validation
