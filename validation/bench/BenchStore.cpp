#include "validation/bench/BenchStore.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "scenes/Error.h"
#include "validation/AtomicFile.h"
#include "validation/PictureFile.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchJsonTerms.h"

namespace tessera::validation {

namespace {

namespace fs = std::filesystem;

/// Of the kept files; raised when older ones can no longer be read.
constexpr int kStoreSchema = 1;

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

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(fmt::format("{}: cannot be read", file.string()));
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// What `read` makes of the file's JSON; a damaged file is the user's to decide about.
template <typename Read>
auto readJson(const fs::path& file, Read&& read) {
    const std::string text = bytesOf(file);
    try {
        return read(Json::parse(text));
    } catch (const std::exception& error) {
        throw InputError(
            fmt::format("{}: is damaged ({}); remove it to measure its points again", file.string(), error.what()));
    }
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

Json runIn(const std::string& folder) {
    if (!fs::exists(runFile(folder)))
        throw InputError(fmt::format("{}: holds no bench; there is no {}", folder, runFile(folder).string()));
    return readJson(runFile(folder), [](const Json& run) {
        if (run.at("schema") != kStoreSchema) throw InputError("it is of another version of tessera");
        for (const char* name : {"machine", "renderer", "commit", "settings", "against", "frames", "shard", "command",
                                 "groups", "skipped"})
            run.at(name);
        shardText(run);
        return run;
    });
}

/// Throws InputError that says in what two runs differ.
void requireSameRun(const Json& a, const std::string& nameA, const Json& b, const std::string& nameB) {
    for (const char* name : {"machine", "renderer", "commit", "settings", "against", "frames"}) {
        if (a.at(name) == b.at(name)) continue;
        throw InputError(fmt::format("{} and {} cannot be put together: {} differs, {} and {}", nameA, nameB, name,
                                     a.at(name).dump(), b.at(name).dump()));
    }
    if (a.at("groups") != b.at("groups"))
        throw InputError(fmt::format("{} and {} cannot be put together: scenes or matrix differ", nameA, nameB));
}

bool isOfShard(std::size_t group, int shard, int shards) {
    return int(group % std::size_t(shards)) == shard - 1;
}

GroupState stateIn(const std::string& folder, std::size_t group) {
    const fs::path file = groupFile(folder, group);
    if (!fs::exists(file)) return {};
    return readJson(file, [](const Json& json) {
        GroupState state;
        state.isDone = json.at("done").get<bool>();
        state.roundsMs = json.at("roundsMs").get<std::vector<std::vector<double>>>();
        state.group = groupFromJson(json.at("group"));
        return state;
    });
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
    throw InputError(fmt::format("{} holds an unfinished bench; go on with --resume, or remove {}", folder,
                                 partsOf(folder).string()));
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

BenchStore::BenchStore(const std::string& folder, const RunIdentity& identity, const BenchPlan& plan, bool resume)
    : folder_(folder), shard_(identity.shard), shards_(identity.shards) {
    const Json run = identityJson(identity, plan);
    if (resume && fs::exists(runFile(folder))) {
        const Json kept = runIn(folder);
        requireSameRun(kept, "the run in " + folder, run, "this one");
        if (kept.at("shard") != run.at("shard"))
            throw InputError(fmt::format("{} holds shard {}, not {}; name another folder, or that shard", folder,
                                         shardText(kept), shardText(run)));
        return;
    }
    requireNoUnfinishedRun(folder);
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
    record.isComplete = true;
    for (std::size_t i = 0; i < run.at("groups").size(); ++i) {
        GroupState state = stateIn(folder, i);
        record.isComplete = record.isComplete && state.isDone;
        if (!state.group.results.empty()) record.groups.push_back(std::move(state.group));
    }
    return record;
}

std::vector<std::uint8_t> keptPicture(const std::string& folder, const std::string& file) {
    const std::string bytes = bytesOf(partsOf(folder) / file);
    return {bytes.begin(), bytes.end()};
}

void mergeRuns(const std::vector<std::string>& shards, const std::string& folder) {
    const Json first = runIn(shards.front());
    const int count = first.at("shard").at(1).get<int>();
    std::vector<std::string> folderOf(static_cast<std::size_t>(count));
    for (const std::string& shard : shards) {
        const Json run = runIn(shard);
        requireSameRun(first, shards.front(), run, shard);
        if (run.at("shard").at(1) != count)
            throw InputError(fmt::format("{} is shard {} and {} is shard {}: of different numbers of shards",
                                         shards.front(), shardText(first), shard, shardText(run)));
        std::string& place = folderOf.at(std::size_t(run.at("shard").at(0).get<int>() - 1));
        if (!place.empty())
            throw InputError(fmt::format("{} and {} are both shard {}; leave one out", place, shard, shardText(run)));
        if (!isFinished(shard, run))
            throw InputError(fmt::format("{} is not finished; go on with --resume there first", shard));
        place = shard;
    }
    for (std::size_t i = 0; i < folderOf.size(); ++i) {
        if (folderOf[i].empty())
            throw InputError(fmt::format("shard {}/{} is missing; name its folder too", i + 1, count));
        if (fs::exists(folder) && fs::equivalent(folderOf[i], folder))
            throw InputError(fmt::format("{} is a shard and cannot be written over; name another folder", folder));
    }
    requireNoUnfinishedRun(folder);
    clearParts(folder);
    for (const std::string& shard : folderOf) {
        for (const fs::directory_entry& entry : fs::directory_iterator(partsOf(shard))) {
            if (entry.path().filename() != "run.json")
                writeFileAtomically((partsOf(folder) / entry.path().filename()).string(), bytesOf(entry.path()));
        }
    }
    Json run = first;
    run["shard"] = {1, 1};
    const std::string part = fmt::format(" --shard {}", shardText(first));
    std::string command = run.at("command").get<std::string>();
    if (const std::size_t at = command.find(part); at != std::string::npos) command.erase(at, part.size());
    run["command"] = command;
    // Last, so that a merge cut short is no run.
    writeFileAtomically(runFile(folder).string(), run.dump(1) + "\n");
}

} // namespace tessera::validation
