#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/bench/BenchRecord.h"
#include "validation/report/Report.h"

/// The same points measured by several machines, a column each. What is compared across them is the picture's error;
/// times are put in relation within a machine alone, since a machine's time says nothing of a technique on another one.
namespace tessera::validation {

/// What one machine measured, all of a run or a share.
struct MachineBench {
    std::string folder; ///< of its own record and page, from the common page on: "machines/1"
    BenchRecord record;
};

/// A point on one machine.
struct MachineCell {
    const BenchResult* result = nullptr;
    double timesFastest = 1.0; ///< its time over that of the fastest point of its group on this machine
    bool isRecommended = false;
};

/// A point, by machine; none where that machine did not measure its group.
struct MachineRow {
    std::string point;
    std::vector<std::optional<MachineCell>> cells;
};

struct MachineGroup {
    const BenchGroup* group = nullptr; ///< of the first machine that measured it
    std::vector<MachineRow> rows;
};

/// Every group that any machine measured, scenes in the order in which they are first met, then by pixels and lights.
/// Pointers into `machines`.
std::vector<MachineGroup> machineGroups(std::span<const MachineBench> machines);

inline constexpr int kMachinesSchema = 1;
std::string machinesJson(std::span<const MachineBench> machines);  ///< the `machines` record of the documentation
std::string machinesTable(std::span<const MachineBench> machines); ///< for people
Report machinesReport(std::span<const MachineBench> machines);

} // namespace tessera::validation
