#pragma once
#include <string>
#include <vector>

#include "validation/bench/FolderLock.h"

/// Puts what was measured in parts together.
namespace tessera::validation {

/// Puts finished shards of one run together in `folder`, which is made where it is missing, and returns the lock on it
/// for what else is to be written there. Throws InputError when they are of different machines, of different runs or of
/// a scene that changed between them, saying in what, when a shard is unfinished, missing or given twice, and when the
/// folder holds an unfinished run; std::runtime_error when another process uses the folder.
FolderLock mergeRuns(const std::vector<std::string>& shards, const std::string& folder);

/// The folders of shards by what measured them, a machine with its renderer and driver, in the order in which these are
/// first named. Throws InputError where a folder holds no run.
std::vector<std::vector<std::string>> shardsByMachine(const std::vector<std::string>& shards);

/// Where the share of a machine, counted from 0, is put: "FOLDER/machines/1".
std::string machineFolder(const std::string& folder, std::size_t machine);

/// Puts the shards of several machines together, of each in its machineFolder(), and returns the lock on `folder`. A
/// machine may have measured all of the run or some shards, of any number, but each group is measured somewhere. Throws
/// as mergeRuns() does, before anything is written; and where `folder` holds a run itself.
FolderLock mergeMachines(const std::vector<std::vector<std::string>>& machines, const std::string& folder);

} // namespace tessera::validation
