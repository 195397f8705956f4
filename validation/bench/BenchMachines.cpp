#include "validation/bench/BenchMachines.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/Recommend.h"
#include "validation/figures/FigureText.h"

namespace tessera::validation {

namespace {

bool isSameGroup(const BenchGroup& a, const BenchGroup& b) {
    return a.scene == b.scene && a.lights == b.lights && a.sizePixels == b.sizePixels;
}

const BenchGroup* groupOn(const MachineBench& machine, const BenchGroup& wanted) {
    const auto found = std::ranges::find_if(machine.record.groups,
                                            [&](const BenchGroup& group) { return isSameGroup(group, wanted); });
    return found == machine.record.groups.end() ? nullptr : &*found;
}

/// The groups of all machines, each once.
std::vector<const BenchGroup*> groupsOf(std::span<const MachineBench> machines) {
    std::vector<const BenchGroup*> groups;
    std::vector<std::string> scenes;
    for (const MachineBench& machine : machines) {
        for (const BenchGroup& group : machine.record.groups) {
            if (std::ranges::none_of(groups, [&](const BenchGroup* other) { return isSameGroup(*other, group); }))
                groups.push_back(&group);
            if (std::ranges::find(scenes, group.scene) == scenes.end()) scenes.push_back(group.scene);
        }
    }
    std::ranges::stable_sort(groups, {}, [&scenes](const BenchGroup* group) {
        return std::tuple(std::ranges::find(scenes, group->scene) - scenes.begin(),
                          std::int64_t(group->sizePixels.x) * group->sizePixels.y, group->lights);
    });
    return groups;
}

/// Adds a machine's results to the rows, as one column.
void addColumn(std::vector<MachineRow>& rows, std::size_t machine, std::size_t machines, const BenchGroup& group) {
    double fastestMs = std::numeric_limits<double>::infinity();
    for (const BenchResult& result : group.results) fastestMs = std::min(fastestMs, result.times.cpuMs.median);
    const std::optional<Recommendation> choice = recommendFor(group);
    for (const BenchResult& result : group.results) {
        const std::string name = pointName(result.key);
        auto row = std::ranges::find(rows, name, &MachineRow::point);
        if (row == rows.end()) row = rows.insert(rows.end(), MachineRow{name, {}});
        row->cells.resize(machines);
        row->cells[machine] = MachineCell{&result, fastestMs > 0.0 ? result.times.cpuMs.median / fastestMs : 1.0,
                                          choice && choice->recommends(result)};
    }
}

std::string cellText(const std::optional<MachineCell>& cell) {
    if (!cell) return "-";
    const std::optional<BenchError>& error = cell->result->error;
    return fmt::format("{:.1f} ms  {:.2f}x  {}{}", cell->result->times.cpuMs.median, cell->timesFastest,
                       error && error->relMse ? figureText(*error->relMse) : "-", cell->isRecommended ? " *" : "  ");
}

Json cellJson(const std::optional<MachineCell>& cell) {
    if (!cell) return nullptr;
    const std::optional<BenchError>& error = cell->result->error;
    return {{"cpuMs", cell->result->times.cpuMs.median},
            {"p95", cell->result->times.cpuMs.p95},
            {"timesFastest", cell->timesFastest},
            {"relMse", orNull(error ? error->relMse : std::nullopt)},
            {"recommended", cell->isRecommended}};
}

} // namespace

std::vector<MachineGroup> machineGroups(std::span<const MachineBench> machines) {
    std::vector<MachineGroup> groups;
    for (const BenchGroup* const group : groupsOf(machines)) {
        MachineGroup& shown = groups.emplace_back(MachineGroup{group, {}});
        for (std::size_t i = 0; i < machines.size(); ++i)
            if (const BenchGroup* const measured = groupOn(machines[i], *group))
                addColumn(shown.rows, i, machines.size(), *measured);
    }
    return groups;
}

std::string machinesJson(std::span<const MachineBench> machines) {
    Json columns = Json::array(), points = Json::array();
    for (const MachineBench& machine : machines) {
        const BenchRecord& record = machine.record;
        columns.push_back({{"folder", machine.folder},
                           {"machine", record.machine},
                           {"renderer", record.renderer},
                           {"driver", record.driver},
                           {"complete", record.isComplete},
                           {"command", record.command},
                           {"recommendation", recommendationText(record.groups)}});
    }
    for (const MachineGroup& group : machineGroups(machines)) {
        for (const MachineRow& row : group.rows) {
            Json cells = Json::array();
            for (const std::optional<MachineCell>& cell : row.cells) cells.push_back(cellJson(cell));
            points.push_back({{"scene", group.group->scene},
                              {"lights", group.group->lights},
                              {"size", {group.group->sizePixels.x, group.group->sizePixels.y}},
                              {"point", row.point},
                              {"machines", cells}});
        }
    }
    const Json json = {{"schema", kMachinesSchema},
                       {"commit", machines.front().record.commit},
                       {"frames", machines.front().record.frames},
                       {"machines", columns},
                       {"points", points}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string machinesTable(std::span<const MachineBench> machines) {
    std::string text;
    std::vector<std::string> titles{"point"};
    for (std::size_t i = 0; i < machines.size(); ++i) {
        const BenchRecord& record = machines[i].record;
        text += fmt::format("machine {}: {}; {}; OpenGL {}\n", i + 1, record.machine, record.renderer, record.driver);
        titles.push_back(fmt::format("machine {}", i + 1));
    }
    text += "Each cell: the median time, that over the machine's fastest point, relMSE; * is recommended there.\n";
    for (const MachineGroup& group : machineGroups(machines)) {
        std::vector<std::vector<std::string>> rows{titles};
        for (const MachineRow& row : group.rows) {
            std::vector<std::string>& cells = rows.emplace_back(std::vector<std::string>{row.point});
            for (const std::optional<MachineCell>& cell : row.cells) cells.push_back(cellText(cell));
        }
        text += fmt::format("\n{}\n{}", groupName(*group.group), textTable(rows, 1));
    }
    return text;
}

} // namespace tessera::validation
