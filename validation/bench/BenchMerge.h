#pragma once
#include <string>
#include <vector>

#include "validation/bench/FolderLock.h"

/// Merges the shards of benchmark runs.
namespace tessera::validation {

/// Merges finished shards of one run into `folder`, created if missing, and returns its lock for further writes. Throws
/// InputError, naming the difference, if shards come from different machines or runs or a scene changed between them;
/// if a shard is unfinished, missing or given twice; and if the folder holds an unfinished run. Throws
/// std::runtime_error if another process uses the folder.
FolderLock mergeRuns(const std::vector<std::string>& shards, const std::string& folder);

/// Groups shard folders by machine, renderer and driver, in order of first appearance. Throws InputError if a folder
/// holds no run.
std::vector<std::vector<std::string>> shardsByMachine(const std::vector<std::string>& shards);

/// The folder for a machine's merged shards: "FOLDER/machines/1" for `machine` 0.
std::string machineFolder(const std::string& folder, std::size_t machine);

/// Merges the shards of several machines, each into its machineFolder(), and returns the lock on `folder`. A machine
/// may have measured the whole run or some shards, with its own shard count, but every group must have been measured.
/// Throws like mergeRuns(), before anything is written, and if `folder` itself holds a run.
FolderLock mergeMachines(const std::vector<std::vector<std::string>>& machines, const std::string& folder);

} // namespace tessera::validation
