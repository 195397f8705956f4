#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"
#include "validation/bench/BenchJsonTerms.h"
#include "validation/bench/MeasureGroup.h"

/// The files of a benchmark's folder `parts`, for the sources that keep, read and merge them.
namespace tessera::validation {

/// Of the kept files; raised when older ones can no longer be read.
inline constexpr int kStoreSchema = 7;

/// In run.json, true: it is one machine's share of a run, the only one that there will be.
inline constexpr const char* kIsShare = "isShare";

/// Fields of run.json that say on what was measured.
inline constexpr const char* kMachineFields[] = {"machine", "renderer", "driver"};
/// Fields in which runs agree whose points may stand beside each other, on one machine or several.
inline constexpr const char* kConditionFields[] = {"commit", "settings", "against", "frames"};

std::filesystem::path partsOf(const std::string& folder);
std::filesystem::path runFile(const std::string& folder);
std::string groupStem(std::size_t group);
std::filesystem::path groupFile(const std::string& folder, std::size_t group);

std::string bytesOf(const std::filesystem::path& file, scenes::LoadLedger& ledger);

/// run.json, whose fields are all there. Throws InputError where it is missing, damaged or of another version.
Json runIn(const std::string& folder);
/// "1/4"
std::string shardText(const Json& run);
/// Whether shard `shard` of `shards`, counted from 1, measures a group.
bool isOfShard(std::size_t group, int shard, int shards);
/// An empty state where nothing is kept. Throws InputError where the file is damaged.
GroupState stateIn(const std::string& folder, std::size_t group);
/// The files of a shard but for run.json. Throws InputError where one is missing.
std::vector<std::filesystem::path> filesOf(const std::string& folder, const Json& run);
/// Whether a shard has all that it is to measure.
bool isFinished(const std::string& folder, const Json& run);
void requireNoUnfinishedRun(const std::string& folder);

/// Two runs to merge, and the remedy if they cannot be merged.
struct RunPair {
    const Json &a, &b;
    std::string nameA, nameB;
    std::string remedy;
};

/// What two runs may differ in besides their shards and commands.
enum class Apart : std::uint8_t { Nothing, Machines };
/// Throws InputError that names another difference of two runs.
void requireSameRun(const RunPair& runs, Apart apart = Apart::Nothing);

/// An empty folder for a new run. What it replaces is finished, and bench.json still has it. Throws InputError where
/// something lies there that no run has made.
void clearParts(const std::string& folder);

} // namespace tessera::validation
