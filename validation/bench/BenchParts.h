#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"
#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/MeasureGroup.h"

/// The files in a benchmark's `parts` folder, for the sources that write, read and merge them.
namespace tessera::validation {

/// Schema version of the kept files; raised when older ones can no longer be read.
inline constexpr int kStoreSchema = 7;

/// Flag in run.json: one machine's part of a run, complete since other machines measured the rest.
inline constexpr const char* kIsShare = "isShare";

/// Fields of run.json that identify the machine.
inline constexpr const char* kMachineFields[] = {"machine", "renderer", "driver"};
/// Fields that must be equal in runs whose points are compared, on one machine or several.
inline constexpr const char* kConditionFields[] = {"commit", "settings", "against", "frames"};

std::filesystem::path partsOf(const std::string& folder);
std::filesystem::path runFile(const std::string& folder);
std::string groupStem(std::size_t group);
std::filesystem::path groupFile(const std::string& folder, std::size_t group);

std::string bytesOf(const std::filesystem::path& file, scenes::LoadLedger& ledger);

/// Reads run.json and checks its fields. Throws InputError if it is missing, damaged or of another version.
Json runIn(const std::string& folder);
/// "1/4"
std::string shardText(const Json& run);
/// Whether shard `shard` of `shards`, counted from 1, measures a group.
bool isOfShard(std::size_t group, int shard, int shards);
/// Loads a group's state; empty if none is kept. Throws InputError if the file is damaged.
GroupState stateIn(const std::string& folder, std::size_t group);
/// The files of a shard except run.json. Throws InputError if one is missing.
std::vector<std::filesystem::path> filesOf(const std::string& folder, const Json& run);
/// Whether all groups of a shard are measured.
bool isFinished(const std::string& folder, const Json& run);
void requireNoUnfinishedRun(const std::string& folder);

/// Two runs to merge, and the remedy if they cannot be merged.
struct RunPair {
    const Json &a, &b;
    std::string nameA, nameB;
    std::string remedy;
};

/// Allowed differences between two runs, besides shard and command.
enum class Apart : std::uint8_t { Nothing, Machines };
/// Throws InputError, naming the difference, if two runs differ otherwise.
void requireSameRun(const RunPair& runs, Apart apart = Apart::Nothing);

/// Empties the parts folder for a new run. A finished run replaced by it remains in bench.json. Throws InputError if
/// the folder contains anything that no run wrote.
void clearParts(const std::string& folder);

} // namespace tessera::validation
