#include "validation/bench/BenchStore.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/PictureFile.h"
#include "scenes/import/FileBytes.h"
#include "scenes/import/JsonText.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchJsonTerms.h"

namespace tessera::validation {

namespace {

namespace fs = std::filesystem;

/// Of the kept files; raised when older ones can no longer be read.
constexpr int kStoreSchema = 6;

fs::path partsOf(const std::string& folder) {
    return fs::path(folder) / "parts";
}

fs::path runFile(const std::string& folder) {
    return partsOf(folder) / "run.json";
}

std::string groupStem(std::size_t group) {
    return fmt::format("group-{:03}", group);
}

fs::path groupFile(const std::string& folder, std::size_t group) {
    return partsOf(folder) / (groupStem(group) + ".json");
}

std::string bytesOf(const fs::path& file, scenes::LoadLedger& ledger) {
    const std::vector<std::byte> bytes = scenes::readFileBytes(file, ledger);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// What `read` makes of the file's JSON; a damaged file is the user's to decide about, and `remedy` says how.
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

Json planJson(const BenchPlan& plan) {
    Json groups = Json::array();
    for (const PlannedGroup& group : plan.groups) {
        Json points = Json::array();
        for (const BenchPoint& point : group.points) points.push_back(pointName(point.key));
        groups.push_back({{"scene", group.scene},
                          {"lights", group.lights},
                          {"size", {group.sizePixels.x, group.sizePixels.y}},
                          {"triangles", group.triangles},
                          {"fingerprint", fmt::format("{:016x}", group.fingerprint)},
                          {"points", points}});
    }
    return groups;
}

Json identityJson(const RunIdentity& identity, const BenchPlan& plan) {
    Json skipped = Json::array();
    for (const SkippedPoint& point : plan.skipped) skipped.push_back({{"what", point.what}, {"why", point.why}});
    return {{"schema", kStoreSchema},
            {"machine", identity.machine},
            {"renderer", identity.renderer},
            {"commit", identity.commit},
            {"settings", identity.settings},
            {"against", identity.against},
            {"frames", identity.frames},
            {"shard", {identity.shard, identity.shards}},
            {"command", identity.command},
            {"groups", planJson(plan)},
            {"skipped", skipped}};
}

std::string shardText(const Json& run) {
    return fmt::format("{}/{}", run.at("shard").at(0).get<int>(), run.at("shard").at(1).get<int>());
}

/// A whole number of a range. A plain conversion would wrap numbers that leave int.
int wholeNumber(const Json& json, int least, int most) {
    if (!json.is_number_integer() || json.get<double>() < least || json.get<double>() > most)
        throw InputError(fmt::format("{} is no whole number from {} to {}", json.dump(), least, most));
    return json.get<int>();
}

/// Throws the JSON reader's exception if a field that is read later is missing, or InputError.
void requireRunFields(const Json& run) {
    for (const char* name : {"machine", "renderer", "commit", "settings", "against", "command"})
        static_cast<void>(run.at(name).get_ref<const std::string&>());
    static_cast<void>(wholeNumber(run.at("frames"), 1, std::numeric_limits<int>::max()));
    const int shards = wholeNumber(run.at("shard").at(1), 1, kMostShards);
    static_cast<void>(wholeNumber(run.at("shard").at(0), 1, shards));
    for (const Json& skipped : run.at("skipped"))
        for (const char* name : {"what", "why"}) static_cast<void>(skipped.at(name).get_ref<const std::string&>());
    for (const Json& group : run.at("groups")) {
        for (const char* name : {"scene", "fingerprint"})
            static_cast<void>(group.at(name).get_ref<const std::string&>());
        for (const char* name : {"lights", "size", "points"}) static_cast<void>(group.at(name));
    }
}

Json runIn(const std::string& folder) {
    if (!fs::exists(runFile(folder)))
        throw InputError(fmt::format("{}: holds no bench; there is no {}", folder, runFile(folder).string()));
    const std::string remedy = fmt::format("remove {} to measure all of it again", partsOf(folder).string());
    const Json run = readJson(runFile(folder), remedy, [](const Json& json) {
        if (json.at("schema").get<int>() == kStoreSchema) requireRunFields(json);
        return json;
    });
    if (run.at("schema") != kStoreSchema)
        throw InputError(fmt::format("{}: is of another version of tessera; go on with that one, or {}",
                                     runFile(folder).string(), remedy));
    return run;
}

/// Two runs to merge, and the remedy if they cannot be merged.
struct RunPair {
    const Json &a, &b;
    std::string nameA, nameB;
    std::string remedy;
};

[[noreturn]] void refuse(const RunPair& runs, const std::string& why) {
    throw InputError(fmt::format("{} and {} cannot be put together: {}; {}", runs.nameA, runs.nameB, why, runs.remedy));
}

/// Throws InputError that names the difference of two runs.
void requireSameRun(const RunPair& runs) {
    for (const char* name : {"machine", "renderer", "commit", "settings", "against", "frames"}) {
        if (runs.a.at(name) != runs.b.at(name))
            refuse(runs, fmt::format("{} differs, {} and {}", name, runs.a.at(name).dump(), runs.b.at(name).dump()));
    }
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

std::vector<std::string> picturesOf(const GroupState& state) {
    std::vector<std::string> files;
    for (const BenchPicture& picture : state.group.pictures)
        for (const std::string& file : {picture.file, picture.heatMapFile})
            if (!file.empty()) files.push_back(file);
    return files;
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

/// The files of a shard but for run.json. Throws InputError where one is missing.
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

/// An empty folder for a new run. What it replaces is finished, and bench.json still has it.
void clearParts(const std::string& folder) {
    std::error_code error;
    fs::remove_all(partsOf(folder), error);
    if (!error) fs::create_directories(partsOf(folder), error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot write into '{}': {}; name another folder", partsOf(folder).string(), error.message()));
}

} // namespace

BenchStore::BenchStore(const std::string& folder, const RunIdentity& identity, const BenchPlan& plan,
                       EarlierRun earlier)
    : folder_(folder), lock_(folder), shard_(identity.shard), shards_(identity.shards) {
    const Json run = identityJson(identity, plan);
    if (earlier == EarlierRun::Resume && fs::exists(runFile(folder))) {
        const Json kept = runIn(folder);
        requireSameRun({kept, run, "the run in " + folder, "this one",
                        "go on with the command and the scenes that it began with, or name another folder"});
        if (kept.at("shard") != run.at("shard"))
            throw InputError(fmt::format("{} holds shard {}, not {}; name another folder, or that shard", folder,
                                         shardText(kept), shardText(run)));
        return;
    }
    if (earlier != EarlierRun::Replace) requireNoUnfinishedRun(folder);
    clearParts(folder);
    writeFileAtomically(runFile(folder).string(), run.dump(1) + "\n");
}

bool BenchStore::isOfShard(std::size_t group) const {
    return validation::isOfShard(group, shard_, shards_);
}

GroupState BenchStore::load(std::size_t group) const {
    return stateIn(folder_, group);
}

void BenchStore::keep(std::size_t group, const GroupState& state) const {
    const Json json = {{"done", state.isDone}, {"roundsMs", state.roundsMs}, {"group", groupJson(state.group)}};
    writeFileAtomically(groupFile(folder_, group).string(),
                        json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string BenchStore::keepPicture(std::size_t group, const std::string& name, const DisplayImage& image) const {
    const std::string file = fmt::format("{}-{}.png", groupStem(group), name);
    writePng((partsOf(folder_) / file).string(), image);
    return file;
}

BenchRecord recordIn(const std::string& folder) {
    const Json run = runIn(folder);
    BenchRecord record;
    record.machine = run.at("machine").get<std::string>();
    record.renderer = run.at("renderer").get<std::string>();
    record.commit = run.at("commit").get<std::string>();
    record.command = run.at("command").get<std::string>();
    record.frames = run.at("frames").get<int>();
    for (const Json& skipped : run.at("skipped"))
        record.skipped.push_back({skipped.at("what").get<std::string>(), skipped.at("why").get<std::string>()});
    record.shards = run.at("shard").at(1).get<int>();
    for (const Json& group : run.at("groups")) record.plannedPoints += group.at("points").size();
    record.isComplete = true;
    for (std::size_t i = 0; i < run.at("groups").size(); ++i) {
        GroupState state = stateIn(folder, i);
        record.isComplete = record.isComplete && state.isDone;
        if (!state.group.results.empty()) record.groups.push_back(std::move(state.group));
    }
    return record;
}

std::vector<std::uint8_t> keptPicture(const std::string& folder, const std::string& file) {
    scenes::LoadLedger ledger;
    const std::string bytes = bytesOf(partsOf(folder) / file, ledger);
    return {bytes.begin(), bytes.end()};
}

FolderLock mergeRuns(const std::vector<std::string>& shards, const std::string& folder) {
    const Json first = runIn(shards.front());
    const int count = first.at("shard").at(1).get<int>();
    std::vector<fs::path> files;
    std::vector<std::string> folderOf(static_cast<std::size_t>(count));
    for (const std::string& shard : shards) {
        const Json run = runIn(shard);
        requireSameRun({first, run, shards.front(), shard, "measure every shard with the same command and scenes"});
        if (run.at("shard").at(1) != count)
            throw InputError(fmt::format("{} is shard {} and {} is shard {}: of different numbers of shards",
                                         shards.front(), shardText(first), shard, shardText(run)));
        std::string& place = folderOf.at(std::size_t(run.at("shard").at(0).get<int>() - 1));
        if (!place.empty())
            throw InputError(fmt::format("{} and {} are both shard {}; leave one out", place, shard, shardText(run)));
        if (!isFinished(shard, run)) throw InputError(fmt::format("{} is not finished; resume it first", shard));
        place = shard;
        std::ranges::move(filesOf(shard, run), std::back_inserter(files));
    }
    for (std::size_t i = 0; i < folderOf.size(); ++i) {
        if (folderOf[i].empty())
            throw InputError(fmt::format("shard {}/{} is missing; name its folder too", i + 1, count));
        if (fs::exists(folder) && fs::equivalent(folderOf[i], folder))
            throw InputError(fmt::format("{} is a shard and cannot be written over; name another folder", folder));
    }
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot make the folder '{}': {}; name another one", folder, error.message()));
    FolderLock lock(folder);
    requireNoUnfinishedRun(folder);
    clearParts(folder);
    for (const fs::path& file : files) {
        scenes::LoadLedger ledger;
        writeFileAtomically((partsOf(folder) / file.filename()).string(), bytesOf(file, ledger));
    }
    Json run = first;
    run["shard"] = {1, 1};
    const std::string part = fmt::format(" --shard {}", shardText(first));
    std::string command = run.at("command").get<std::string>();
    if (const std::size_t at = command.find(part); at != std::string::npos) command.erase(at, part.size());
    run["command"] = command;
    // Last, so that a merge cut short is no run.
    writeFileAtomically(runFile(folder).string(), run.dump(1) + "\n");
    return lock;
}

} // namespace tessera::validation
