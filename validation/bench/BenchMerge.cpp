#include "validation/bench/BenchMerge.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "validation/bench/BenchParts.h"

namespace tessera::validation {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMergeRemedy = "measure every shard with the same command and scenes";

/// The parts of a merged run.
struct MergePlan {
    Json run; ///< run.json of the merged run
    std::vector<fs::path> files;
};

/// run.json of the merged run, derived from the first shard's.
Json wholeRun(const Json& first, bool isShare) {
    Json run = first;
    run["shard"] = {1, 1};
    if (isShare) run[kIsShare] = true;
    const std::string part = fmt::format(" --shard {}", shardText(first));
    std::string command = run.at("command").get<std::string>();
    if (const std::size_t at = command.find(part); at != std::string::npos) command.erase(at, part.size());
    run["command"] = command;
    return run;
}

/// Checks the shards of one machine. They must be complete unless `mayShare`: then other machines may have the rest.
MergePlan planMerge(const std::vector<std::string>& shards, const std::string& folder, bool mayShare) {
    const Json first = runIn(shards.front());
    const int count = first.at("shard").at(1).get<int>();
    MergePlan plan;
    std::vector<std::string> folderOf(static_cast<std::size_t>(count));
    for (const std::string& shard : shards) {
        const Json run = runIn(shard);
        requireSameRun({first, run, shards.front(), shard, kMergeRemedy});
        if (run.contains(kIsShare))
            throw InputError(fmt::format("{} is a machine's share, put together already; name its shards", shard));
        if (run.at("shard").at(1) != count)
            throw InputError(fmt::format("{} is shard {} and {} is shard {}: of different numbers of shards",
                                         shards.front(), shardText(first), shard, shardText(run)));
        std::string& place = folderOf.at(std::size_t(run.at("shard").at(0).get<int>() - 1));
        if (!place.empty())
            throw InputError(fmt::format("{} and {} are both shard {}; leave one out", place, shard, shardText(run)));
        if (!isFinished(shard, run)) throw InputError(fmt::format("{} is not finished; resume it first", shard));
        place = shard;
        std::ranges::move(filesOf(shard, run), std::back_inserter(plan.files));
    }
    bool isShare = false;
    for (std::size_t i = 0; i < folderOf.size(); ++i) {
        isShare = isShare || folderOf[i].empty();
        if (folderOf[i].empty() && !mayShare)
            throw InputError(fmt::format("shard {}/{} is missing; name its folder too", i + 1, count));
        if (!folderOf[i].empty() && fs::exists(folder) && fs::equivalent(folderOf[i], folder))
            throw InputError(fmt::format("{} is a shard and cannot be written over; name another folder", folder));
    }
    plan.run = wholeRun(first, isShare);
    return plan;
}

FolderLock lockedFolder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot make the folder '{}': {}; name another one", folder, error.message()));
    return FolderLock(folder);
}

FolderLock writeMerge(const MergePlan& plan, const std::string& folder) {
    FolderLock lock = lockedFolder(folder);
    requireNoUnfinishedRun(folder);
    clearParts(folder);
    for (const fs::path& file : plan.files) {
        scenes::LoadLedger ledger;
        writeFileAtomically((partsOf(folder) / file.filename()).string(), bytesOf(file, ledger));
    }
    // Last, so that an interrupted merge does not count as a run.
    writeFileAtomically(runFile(folder).string(), plan.run.dump(1) + "\n");
    return lock;
}

/// Throws InputError if any group was measured by no machine.
void requireEveryGroup(const std::vector<std::vector<std::string>>& machines, std::size_t groups) {
    std::vector<bool> isMeasured(groups);
    for (const std::vector<std::string>& shards : machines) {
        for (const std::string& folder : shards) {
            const Json run = runIn(folder);
            const int shard = run.at("shard").at(0), count = run.at("shard").at(1);
            for (std::size_t i = 0; i < groups; ++i) isMeasured[i] = isMeasured[i] || isOfShard(i, shard, count);
        }
    }
    const auto missing = std::ranges::count(isMeasured, false);
    if (missing == 0) return;
    const std::vector<std::string>& one = machines.front();
    throw InputError(
        fmt::format("{} of {} groups of points were measured by no machine; name the folders of all shards "
                    "besides {}",
                    missing, groups, one.front()));
}

} // namespace

FolderLock mergeRuns(const std::vector<std::string>& shards, const std::string& folder) {
    return writeMerge(planMerge(shards, folder, false), folder);
}

std::vector<std::vector<std::string>> shardsByMachine(const std::vector<std::string>& shards) {
    std::vector<std::vector<std::string>> machines;
    std::vector<Json> runs; // run.json of each machine's first shard
    for (const std::string& shard : shards) {
        Json run = runIn(shard);
        const auto known = std::ranges::find_if(runs, [&run](const Json& other) {
            return std::ranges::all_of(kMachineFields,
                                       [&](const char* field) { return run.at(field) == other.at(field); });
        });
        const auto at = std::size_t(known - runs.begin());
        if (known == runs.end()) {
            runs.push_back(std::move(run));
            machines.emplace_back();
        }
        machines[at].push_back(shard);
    }
    return machines;
}

std::string machineFolder(const std::string& folder, std::size_t machine) {
    return fmt::format("{}/machines/{}", folder, machine + 1);
}

FolderLock mergeMachines(const std::vector<std::vector<std::string>>& machines, const std::string& folder) {
    const std::string& firstFolder = machines.front().front();
    const Json first = runIn(firstFolder);
    std::vector<MergePlan> plans;
    for (std::size_t i = 0; i < machines.size(); ++i) {
        const std::string& shard = machines[i].front();
        requireSameRun({first, runIn(shard), firstFolder, shard, kMergeRemedy}, Apart::Machines);
        plans.push_back(planMerge(machines[i], machineFolder(folder, i), true));
        requireNoUnfinishedRun(machineFolder(folder, i));
    }
    requireEveryGroup(machines, first.at("groups").size());
    if (fs::exists(runFile(folder)))
        throw InputError(fmt::format(
            "{} holds a bench, and what several machines measured is put beside none; name another folder", folder));
    FolderLock lock = lockedFolder(folder);
    for (std::size_t i = 0; i < plans.size(); ++i) writeMerge(plans[i], machineFolder(folder, i));
    return lock;
}

} // namespace tessera::validation
