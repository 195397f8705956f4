#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/bench/BenchRecord.h"
#include "validation/report/Report.h"

/// The same points measured on several machines, one column each. Errors are compared across machines; times only
/// within a machine, since they do not predict a technique's time on another one.
namespace tessera::validation {

/// The measurements of one machine: a whole run or part of one.
struct MachineBench {
    std::string folder; ///< its record and page, relative to the common page: "machines/1"
    BenchRecord record;
};

/// A point on one machine.
struct MachineCell {
    const BenchResult* result = nullptr;
    double timesFastest = 1.0; ///< its time over that of the fastest point of its group on this machine
    bool isRecommended = false;
};

/// A point on each machine; unset where a machine did not measure its group.
struct MachineRow {
    std::string point;
    std::vector<std::optional<MachineCell>> cells;
};

struct MachineGroup {
    const BenchGroup* group = nullptr; ///< of the first machine that measured it
    std::vector<MachineRow> rows;
};

/// Every group that any machine measured, ordered by first appearance of its scene, then by pixels and lights. Holds
/// pointers into `machines`.
std::vector<MachineGroup> machineGroups(std::span<const MachineBench> machines);

inline constexpr int kMachinesSchema = 1;
std::string machinesJson(std::span<const MachineBench> machines);  ///< the `machines` record of the documentation
std::string machinesTable(std::span<const MachineBench> machines); ///< for people
Report machinesReport(std::span<const MachineBench> machines);

} // namespace tessera::validation
