#include "validation/bench/BenchParts.h"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/Files.h"
#include "scenes/import/JsonReader.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchStore.h"

namespace tessera::validation {

namespace {

namespace fs = std::filesystem;

/// Parses a JSON file and returns read(json). Throws InputError with the advice `remedy` if the file is damaged.
template <typename Read>
auto readJson(const fs::path& file, const std::string& remedy, Read&& read) {
    scenes::LoadLedger ledger;
    const std::string text = bytesOf(file, ledger);
    ledger.charge(scenes::parsedJsonBytes(text), [&] { return file.string() + ": its JSON"; });
    std::string what;
    try {
        scenes::requireJsonDepth(text, file);
        return read(Json::parse(text));
    } catch (const Json::parse_error&) {
        what = "it is no whole JSON document";
    } catch (const Json::exception&) {
        what = "a field is missing or of another kind than tessera writes";
    } catch (const std::bad_optional_access&) {
        what = "a time is missing";
    } catch (const InputError& error) {
        what = error.what();
    }
    throw InputError(fmt::format("{}: is damaged: {}; {}", file.string(), what, remedy));
}

/// Throws Json::exception or InputError if a field that is read later is missing or invalid.
void requireRunFields(const Json& run) {
    for (const char* name : {"machine", "renderer", "driver", "commit", "settings", "against", "command"})
        static_cast<void>(run.at(name).get_ref<const std::string&>());
    static_cast<void>(wholeNumber(run.at("frames"), 1));
    const int shards = wholeNumber(run.at("shard").at(1), 1, kMostShards);
    static_cast<void>(wholeNumber(run.at("shard").at(0), 1, shards));
    if (run.contains(kIsShare)) static_cast<void>(run.at(kIsShare).get_ref<const bool&>());
    for (const Json& skipped : run.at("skipped"))
        for (const char* name : {"what", "why"}) static_cast<void>(skipped.at(name).get_ref<const std::string&>());
    for (const Json& group : run.at("groups")) {
        for (const char* name : {"scene", "fingerprint"})
            static_cast<void>(group.at(name).get_ref<const std::string&>());
        for (const char* name : {"lights", "size", "points"}) static_cast<void>(group.at(name));
    }
}

[[noreturn]] void refuse(const RunPair& runs, const std::string& why) {
    throw InputError(fmt::format("{} and {} cannot be put together: {}; {}", runs.nameA, runs.nameB, why, runs.remedy));
}

constexpr std::string_view kRunName = "run.json", kGroupPrefix = "group-", kTemporaryPrefix = ".tessera-";

/// Whether a run wrote this file, including interrupted runs.
bool isPart(const fs::directory_entry& entry) {
    std::error_code ignored;
    const std::string name = entry.path().filename().string();
    return entry.is_regular_file(ignored) &&
           (name == kRunName || name.starts_with(kGroupPrefix) || name.starts_with(kTemporaryPrefix));
}

/// The first entry of a parts folder that no run wrote, or a file in the folder's place; unset if none.
std::optional<fs::path> foreignIn(const fs::path& parts) {
    std::error_code error;
    if (!fs::is_directory(parts, error)) return fs::exists(parts, error) ? std::optional(parts) : std::nullopt;
    for (fs::directory_iterator entry(parts, error), end; !error && entry != end; entry.increment(error))
        if (!isPart(*entry)) return entry->path();
    return std::nullopt;
}

std::vector<std::string> picturesOf(const GroupState& state) {
    std::vector<std::string> files;
    for (const BenchPicture& picture : state.group.pictures)
        for (const std::string& file : {picture.file, picture.heatMapFile})
            if (!file.empty()) files.push_back(file);
    return files;
}

} // namespace

fs::path partsOf(const std::string& folder) {
    return fs::path(folder) / "parts";
}

fs::path runFile(const std::string& folder) {
    return partsOf(folder) / kRunName;
}

std::string groupStem(std::size_t group) {
    return fmt::format("{}{:03}", kGroupPrefix, group);
}

fs::path groupFile(const std::string& folder, std::size_t group) {
    return partsOf(folder) / (groupStem(group) + ".json");
}

std::string bytesOf(const fs::path& file, scenes::LoadLedger& ledger) {
    const std::vector<std::byte> bytes = scenes::readFileBytes(file, ledger);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string shardText(const Json& run) {
    return fmt::format("{}/{}", run.at("shard").at(0).get<int>(), run.at("shard").at(1).get<int>());
}

Json runIn(const std::string& folder) {
    if (!fs::exists(runFile(folder)))
        throw InputError(fmt::format("{}: holds no bench; there is no {}", folder, runFile(folder).string()));
    const std::string remedy = fmt::format("remove {} to measure all of it again", partsOf(folder).string());
    const Json run = readJson(runFile(folder), remedy, [](const Json& json) {
        if (json.at("schema") == kStoreSchema) requireRunFields(json);
        return json;
    });
    if (run.at("schema") != kStoreSchema)
        throw InputError(fmt::format("{}: is of another version of tessera; go on with that one, or {}",
                                     runFile(folder).string(), remedy));
    return run;
}

void requireSameRun(const RunPair& runs, Apart apart) {
    const auto require = [&runs](std::span<const char* const> fields) {
        for (const char* name : fields) {
            if (runs.a.at(name) != runs.b.at(name))
                refuse(runs,
                       fmt::format("{} differs, {} and {}", name, runs.a.at(name).dump(), runs.b.at(name).dump()));
        }
    };
    if (apart == Apart::Nothing) require(kMachineFields);
    require(kConditionFields);
    const Json &groupsA = runs.a.at("groups"), &groupsB = runs.b.at("groups");
    if (groupsA == groupsB) return;
    for (std::size_t i = 0; i < std::min(groupsA.size(), groupsB.size()); ++i) {
        const auto isSame = [&](const char* name) { return groupsA[i].at(name) == groupsB[i].at(name); };
        if (isSame("scene") && isSame("lights") && isSame("size") && !isSame("fingerprint"))
            refuse(runs, fmt::format("the scene {} changed between them", groupsA[i].at("scene").get<std::string>()));
    }
    refuse(runs, "scenes or matrix differ");
}

bool isOfShard(std::size_t group, int shard, int shards) {
    return int(group % std::size_t(shards)) == shard - 1;
}

GroupState stateIn(const std::string& folder, std::size_t group) {
    const fs::path file = groupFile(folder, group);
    if (!fs::exists(file)) return {};
    return readJson(file, "remove it and resume the bench", [](const Json& json) {
        GroupState state;
        state.isDone = json.at("done").get<bool>();
        state.roundsMs = json.at("roundsMs").get<std::vector<std::vector<double>>>();
        state.group = groupFromJson(json.at("group"));
        for (const std::vector<double>& round : state.roundsMs)
            if (round.size() != state.roundsMs.front().size()) throw InputError("its rounds differ in length");
        for (const std::string& picture : picturesOf(state))
            if (picture.empty() || fs::path(picture).filename() != picture)
                throw InputError(fmt::format("'{}' is no name of a picture beside it", picture));
        return state;
    });
}

std::vector<fs::path> filesOf(const std::string& folder, const Json& run) {
    std::vector<fs::path> files;
    const int shard = run.at("shard").at(0), shards = run.at("shard").at(1);
    for (std::size_t i = 0; i < run.at("groups").size(); ++i) {
        if (!isOfShard(i, shard, shards)) continue;
        files.push_back(groupFile(folder, i));
        for (const std::string& picture : picturesOf(stateIn(folder, i))) files.push_back(partsOf(folder) / picture);
    }
    for (const fs::path& file : files)
        if (!fs::is_regular_file(file))
            throw InputError(fmt::format("{}: is missing; bring it back, or measure the shard again", file.string()));
    return files;
}

bool isFinished(const std::string& folder, const Json& run) {
    if (run.contains(kIsShare)) return true;
    const int shard = run.at("shard").at(0), shards = run.at("shard").at(1);
    for (std::size_t i = 0; i < run.at("groups").size(); ++i) {
        if (isOfShard(i, shard, shards) && !stateIn(folder, i).isDone) return false;
    }
    return true;
}

void requireNoUnfinishedRun(const std::string& folder) {
    if (!fs::exists(runFile(folder)) || isFinished(folder, runIn(folder))) return;
    throw InputError(
        fmt::format("{} holds an unfinished bench; resume it, or remove {}", folder, partsOf(folder).string()));
}

void clearParts(const std::string& folder) {
    if (const std::optional<fs::path> foreign = foreignIn(partsOf(folder)))
        throw InputError(fmt::format("{}: is no file of a bench, and would be lost; move it away, or name another "
                                     "folder",
                                     foreign->string()));
    std::error_code error;
    fs::remove_all(partsOf(folder), error);
    if (!error) fs::create_directories(partsOf(folder), error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot write into '{}': {}; name another folder", partsOf(folder).string(), error.message()));
}

} // namespace tessera::validation
