#include "validation/bench/BenchStore.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/PictureFile.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchParts.h"

namespace tessera::validation {

namespace {

namespace fs = std::filesystem;

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
    return {{"schema", kStoreSchema},      {"machine", identity.machine}, {"renderer", identity.renderer},
            {"driver", identity.driver},   {"commit", identity.commit},   {"settings", identity.settings},
            {"against", identity.against}, {"frames", identity.frames},   {"shard", {identity.shard, identity.shards}},
            {"command", identity.command}, {"groups", planJson(plan)},    {"skipped", skipped}};
}

/// Throws InputError if the folder holds another shard: it must stay until the shards are merged.
void requireNoOtherShard(const std::string& folder, const Json& run) {
    if (!fs::exists(runFile(folder))) return;
    const Json kept = runIn(folder);
    const Json shard = run.at("shard"), other = kept.at("shard");
    if (other.at(1) != 1 && other != shard)
        throw InputError(
            fmt::format("{} holds shard {}, which shard {} would replace; name another folder, or remove {}", folder,
                        shardText(kept), shardText(run), partsOf(folder).string()));
}

} // namespace

BenchStore::BenchStore(const std::string& folder, const RunIdentity& identity, const BenchPlan& plan,
                       EarlierRun earlier)
    : folder_(folder), lock_(folder), shard_(identity.shard), shards_(identity.shards) {
    // Compares via JSON text, like stored runs: it replaces bytes of file names that are not UTF-8.
    const std::string text = identityJson(identity, plan).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    const Json run = Json::parse(text);
    if (earlier == EarlierRun::Resume && fs::exists(runFile(folder))) {
        const Json kept = runIn(folder);
        const RunPair runs{kept, run, "the run in " + folder, "this one",
                           "go on with the command and the scenes that it began with, or name another folder"};
        requireSameRun(runs);
        if (kept.at("shard") != run.at("shard"))
            throw InputError(fmt::format("{} holds shard {}, not {}; name another folder, or that shard", folder,
                                         shardText(kept), shardText(run)));
        return;
    }
    if (earlier != EarlierRun::Replace) {
        requireNoUnfinishedRun(folder);
        requireNoOtherShard(folder, run);
    }
    clearParts(folder);
    writeFileAtomically(runFile(folder).string(), text);
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
    record.driver = run.at("driver").get<std::string>();
    record.commit = run.at("commit").get<std::string>();
    record.command = run.at("command").get<std::string>();
    record.frames = run.at("frames").get<int>();
    for (const Json& skipped : run.at("skipped"))
        record.skipped.push_back({skipped.at("what").get<std::string>(), skipped.at("why").get<std::string>()});
    record.shards = run.at("shard").at(1).get<int>();
    for (const Json& group : run.at("groups")) record.plannedPoints += group.at("points").size();
    record.isShare = run.value(kIsShare, false);
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

} // namespace tessera::validation
