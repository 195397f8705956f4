#include "validation/bench/BenchMachines.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/support/TempFolder.h"
#include "tests/unit/validation/Benches.h"
#include "validation/bench/BenchMerge.h"

namespace tessera::validation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BenchMachines : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    /// Writes a finished shard of four groups, measured on a machine with frames of `ms`.
    std::string shardOn(const std::string& name, const std::string& machine, int shard, int shards, double ms,
                        const std::string& commit = "abc") const {
        fs::create_directory(path(name));
        RunIdentity identity = madeUpIdentity(shard, shards);
        identity.machine = machine;
        identity.commit = commit;
        const BenchStore store(path(name), identity, madeUpPlan(4), EarlierRun::Keep);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!store.isOfShard(i)) continue;
            GroupState state;
            state.roundsMs = {{ms}};
            state.group =
                madeUpGroup(10 << i, {madeUpResult("forward", ms, 1e-9), madeUpResult("deferred", ms / 4.0, 1e-9)});
            state.isDone = true;
            store.keep(i, state);
        }
        return path(name);
    }

    std::vector<MachineBench> merged(const std::vector<std::string>& shards) const {
        const std::vector<std::vector<std::string>> machines = shardsByMachine(shards);
        mergeMachines(machines, path("all"));
        std::vector<MachineBench> benches;
        for (std::size_t i = 0; i < machines.size(); ++i)
            benches.push_back({"machines/" + std::to_string(i + 1), recordIn(machineFolder(path("all"), i))});
        return benches;
    }

    test::TempFolder folder_;
};

TEST_F(BenchMachines, eachMachineIsAColumnWithRatiosOfItsOwn) {
    const std::vector<MachineBench> machines =
        merged({shardOn("a", "A", 1, 1, 8.0), shardOn("b2", "B", 2, 2, 40.0), shardOn("b1", "B", 1, 2, 20.0)});
    ASSERT_EQ(machines.size(), 2u);
    EXPECT_TRUE(machines[0].record.isComplete && machines[1].record.isComplete);
    const std::vector<MachineGroup> groups = machineGroups(machines);
    ASSERT_EQ(groups.size(), 4u);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_EQ(groups[i].group->lights, 10 << i);
        ASSERT_EQ(groups[i].rows.size(), 2u);
        const MachineRow& forward = groups[i].rows[0];
        ASSERT_TRUE(forward.cells.size() == 2 && forward.cells[0] && forward.cells[1]);
        EXPECT_EQ(forward.cells[0]->result->times.cpuMs.median, 8.0);
        EXPECT_EQ(forward.cells[1]->result->times.cpuMs.median, i % 2 == 0 ? 20.0 : 40.0);
        for (const MachineRow& row : groups[i].rows) {
            const bool isFast = row.point.starts_with("deferred");
            for (const std::optional<MachineCell>& cell : row.cells) {
                EXPECT_EQ(cell->timesFastest, isFast ? 1.0 : 4.0) << "of the machine's own fastest point";
                EXPECT_EQ(cell->isRecommended, isFast);
            }
        }
    }
}

TEST_F(BenchMachines, groupsThatAMachineDidNotMeasureAreEmptyAndSaidToBeElsewhere) {
    const std::vector<MachineBench> machines = merged({shardOn("a", "A", 1, 2, 8.0), shardOn("b", "B", 2, 2, 20.0)});
    const std::vector<MachineGroup> groups = machineGroups(machines);
    ASSERT_EQ(groups.size(), 4u);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_EQ(groups[i].group->lights, 10 << i) << "in the order of lights, from any machine";
        const std::size_t has = i % 2;
        EXPECT_TRUE(groups[i].rows[0].cells[has]);
        EXPECT_FALSE(groups[i].rows[0].cells[1 - has]);
    }
    EXPECT_THAT(unfinishedText(machines[0].record),
                HasSubstr("This machine measured 4 of 4 points. Others measured the rest."));
    const auto json = nlohmann::json::parse(machinesJson(machines));
    EXPECT_EQ(json["machines"][1]["machine"], "B");
    EXPECT_EQ(json["machines"][1]["complete"], false);
    EXPECT_EQ(json["points"].size(), 8u);
    EXPECT_TRUE(json["points"][0]["machines"][1].is_null());
    EXPECT_EQ(json["points"][0]["machines"][0]["timesFastest"], 4.0);
    EXPECT_THAT(machinesTable(machines), testing::AllOf(HasSubstr("machine 2: B; llvmpipe; OpenGL 4.5 Mesa"),
                                                        HasSubstr("8.0 ms  4.00x"), HasSubstr("2.0 ms  1.00x")));
    const std::string html = reportHtml(machinesReport(machines));
    EXPECT_THAT(html, testing::AllOf(HasSubstr("hall on 2 machines"), HasSubstr("href=\"machines/2/report.html\""),
                                     HasSubstr("<strong>2.0 ms, 1.00&times;</strong>"), HasSubstr("&ndash;")));
}

TEST_F(BenchMachines, anotherDriverIsAnotherMachine) {
    const std::string a = shardOn("a", "A", 1, 1, 8.0);
    fs::create_directory(path("b"));
    RunIdentity identity = madeUpIdentity();
    identity.machine = "A";
    identity.driver = "4.6 NVIDIA";
    { const BenchStore store(path("b"), identity, madeUpPlan(4), EarlierRun::Keep); }
    EXPECT_EQ(shardsByMachine({a, path("b"), a}), (std::vector<std::vector<std::string>>{{a, a}, {path("b")}}));
}

TEST_F(BenchMachines, whatCannotStandSideBySideIsRefusedAndNothingIsWritten) {
    const std::string a = shardOn("a", "A", 1, 2, 8.0), b = shardOn("b", "B", 1, 2, 20.0);
    const auto refused = [&](const std::vector<std::string>& shards, const std::string& out = "all") {
        return test::errorText<InputError>([&] { mergeMachines(shardsByMachine(shards), path(out)); });
    };
    EXPECT_THAT(refused({a, b}), HasSubstr("2 of 4 groups of points were measured by no machine"));
    EXPECT_THAT(refused({a, shardOn("c", "B", 2, 2, 20.0, "def")}), HasSubstr("commit differs"));
    EXPECT_THAT(refused({a, b, b}), HasSubstr("both shard 1/2"));
    EXPECT_FALSE(fs::exists(path("all")));
    const std::string rest = shardOn("rest", "B", 2, 2, 20.0);
    EXPECT_THAT(refused({a, rest}, "b"), HasSubstr("holds a bench"));
    EXPECT_EQ(refused({a, rest}), "");
    EXPECT_EQ(refused({a, rest}), "") << "over what is there";
    EXPECT_THAT(refused({machineFolder(path("all"), 0), rest}), HasSubstr("is a machine's share"));
}

} // namespace
} // namespace tessera::validation
