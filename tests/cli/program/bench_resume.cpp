#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "tests/cli/program/Cli.h"
#include "tests/support/Sweep.h"
#include "validation/bench/FolderLock.h"

namespace tessera::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class BenchRuns : public Cli {
protected:
    BenchRuns() {
        folder_.write("m.json", R"({"technique": ["forward", "deferred", "tiled_deferred"],
                                    "layout": ["exact", "packed"], "lights": [4, 16]})");
        folder_.write("fewer.json", R"({"technique": ["forward", "deferred"],
                                        "layout": ["exact", "packed"], "lights": [4, 16]})");
        folder_.write("few.json", R"({"technique": ["forward", "deferred"]})");
    }

    static Words command(const std::string& out, const Words& more = {}) { return commandOf("m.json", out, more); }
    /// Ten points in a whole sweep, else six: in two groups of the run, which two shards measure.
    static Words sharedCommand(const std::string& out, const Words& more = {}) {
        return commandOf(isWholeSweep() ? "m.json" : "fewer.json", out, more);
    }
    /// Two points, for commands that are refused whatever was measured.
    static Words shortCommand(const std::string& out, const Words& more = {}) {
        return commandOf("few.json", out, more);
    }

    /// The record without times.
    Json withoutTimes(const std::string& name) const {
        Json record = json(name);
        for (const char* field : {"floors", "scaling", "recommendation", "recommendations", "command"})
            record.erase(field);
        for (Json& point : record["points"]) {
            for (const char* field :
                 {"cpuMs", "gpuMs", "floorMs", "ratioToFloor", "floorLitMs", "ratioToLitFloor", "pareto", "why"})
                point.erase(field);
            for (Json& pass : point["passes"]) pass.erase("gpuMs");
        }
        return record;
    }

    /// Kills the run after delays that grow by a step, which is longer outside of a whole sweep.
    void expectKillsLeaveNoTrace() const;
    void expectShardsMerge() const;

private:
    static Words commandOf(const char* matrix, const std::string& out, const Words& more) {
        Words words{"bench", "lattice", "--size", "64x36", "--frames", "3", "--matrix", matrix, "-o", out};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
};
using BenchRunsSlow = BenchRuns;

void BenchRuns::expectKillsLeaveNoTrace() const {
    const int stepMilliseconds = isWholeSweep() ? 173 : 997;
    runGood(command("whole"));
    int kills = 0;
    bool isDone = false;
    for (int attempt = 0; attempt < 40 && !isDone; ++attempt) {
        Words words{kProgram};
        for (const std::string& word : command("killed", {"--resume"})) words.push_back(word);
        Process process(words, {folder_.path(), {}, 60.0});
        std::thread killer([&process, attempt, stepMilliseconds] {
            // From a quarter of a second, before anything is measured, up to whole runs.
            std::this_thread::sleep_for(std::chrono::milliseconds(250 + stepMilliseconds * attempt));
            try {
                process.send(SIGKILL);
            } catch (const std::runtime_error&) { // it has ended
            }
        });
        const ProcessResult result = process.wait();
        killer.join();
        isDone = result.exitCode.has_value();
        kills += isDone ? 0 : 1;
        EXPECT_EQ(result.exitCode.value_or(0), 0) << result.err;
    }
    ASSERT_TRUE(isDone);
    EXPECT_GT(kills, 0);
    EXPECT_EQ(withoutTimes("killed/bench.json"), withoutTimes("whole/bench.json"));
    // Finished points are not measured again: the times stay.
    const std::string before = text("killed/bench.json");
    runGood(command("killed", {"--resume"}));
    EXPECT_EQ(text("killed/bench.json"), before);
}
TEST_F(BenchRuns, aRunThatIsKilledAnywhereAndResumedGivesTheSamePoints) {
    expectKillsLeaveNoTrace();
}
TEST_F(BenchRunsSlow, aRunThatIsKilledAnywhereAndResumedGivesTheSamePoints) {
    expectKillsLeaveNoTrace();
}

void BenchRuns::expectShardsMerge() const {
    runGood(sharedCommand("whole"));
    runGood(sharedCommand("one", {"--shard", "1/2"}));
    EXPECT_EQ(json("one/bench.json")["complete"], false);
    runGood(sharedCommand("two", {"--shard", "2/2"}));
    runGood({"bench", "--merge", "two", "one", "-o", "all"});
    EXPECT_EQ(withoutTimes("all/bench.json"), withoutTimes("whole/bench.json"));
    EXPECT_THAT(text("all/report.html"), HasSubstr("Error against run time"));
}
TEST_F(BenchRuns, twoShardsMergedEqualOneRun) {
    expectShardsMerge();
}
TEST_F(BenchRunsSlow, twoShardsMergedEqualOneRun) {
    expectShardsMerge();
}

TEST_F(BenchRuns, shardsThatCannotBeMergedAreRefusedInOneLine) {
    runGood(shortCommand("one", {"--shard", "1/2"}));
    expectError(2, shortCommand("one", {"--shard", "2/2", "--resume"}), {"holds shard 1/2, not 2/2"});
    expectError(2, shortCommand("one", {"--shard", "1/2", "--resume", "--against", "forward"}), {"against differs"});
    expectError(2, {"bench", "--merge", "one", "-o", "all"}, {"shard 2/2 is missing"});
    expectError(2, {"bench", "--merge", "nowhere", "-o", "one"}, {"nowhere", "holds no bench"});
    expectError(2, {"bench", "lattice", "--merge", "one", "-o", "one"}, {"leave scenes"});
    expectError(2, {"bench", "-o", "one"}, {"needs a SCENE"});
    expectError(2, shortCommand("one", {"--shard", "3/2"}), {"--shard 3/2", "1/4"});
    expectError(2, shortCommand("one", {"--shard", "x"}), {"--shard x"});
    expectError(2, shortCommand("one", {"--against", "referense"}), {"did you mean 'reference'"});
    std::filesystem::remove(folder_.path() / "one/parts/group-000.json");
    expectError(2, shortCommand("one"), {"unfinished", "resume it"});
    folder_.write("one/parts/group-000.json", "{}");
    expectError(2, shortCommand("one", {"--shard", "1/2", "--resume"}), {"group-000.json", "is damaged", "remove it"});
}

TEST_F(BenchRuns, runsOfTwoMachinesMergeIntoAPageWithAColumnEach) {
    runGood(shortCommand("mine"));
    std::filesystem::copy(path("mine"), path("theirs"), std::filesystem::copy_options::recursive);
    nlohmann::ordered_json run = nlohmann::ordered_json::parse(text("theirs/parts/run.json"));
    run["machine"] = "64 x Chip <of theirs>";
    folder_.write("theirs/parts/run.json", run.dump(1));
    const std::string table = runGood({"bench", "--merge", "mine", "theirs", "-o", "both"});
    EXPECT_THAT(table, testing::AllOf(HasSubstr("machine 1"), HasSubstr("machine 2: 64 x Chip <of theirs>; "),
                                      HasSubstr("both/report.html")));
    const Json machines = json("both/machines.json");
    EXPECT_EQ(machines["points"].size(), 2u);
    for (const Json& point : machines["points"]) {
        ASSERT_EQ(point["machines"].size(), 2u);
        EXPECT_EQ(point["machines"][0], point["machines"][1]) << "the same run, measured once";
    }
    EXPECT_EQ(text("both/machines/1/bench.csv"), text("mine/bench.csv"));
    EXPECT_EQ(json("both/machines/2/bench.json")["machine"], "64 x Chip <of theirs>");
    EXPECT_THAT(text("both/report.html"), HasSubstr("64 x Chip &lt;of theirs&gt;"));
    // Again, over the existing files.
    runGood({"bench", "--merge", "mine", "theirs", "-o", "both"});
    expectError(2, {"bench", "--merge", "mine", "theirs", "-o", "mine"}, {"mine holds a bench", "another folder"});
    expectError(2, {"bench", "--merge", "both/machines/1", "both/machines/2", "-o", "both"}, {"would be written over"});
}

TEST_F(BenchRuns, aSceneThatIsEditedBetweenTwoPartsOfARunIsRefused) {
    const auto paint = [&](const char* colour) {
        writeQuad(fmt::format(R"({{"name": "paint", "model": "lambert", "k_d": {}}})", colour),
                  R"([{"type": "point", "position": [0, 0, 1]}])");
    };
    const auto bench = [](const std::string& out, const Words& more) {
        Words words{"bench", "quad.json", "--frames", "1", "--matrix", "sizes.json", "-o", out};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    folder_.write("sizes.json", R"({"technique": ["forward", "deferred"], "size": ["32x18", "320x180"]})");
    paint("[1, 1, 1]");
    runGood(bench("one", {"--shard", "1/2"}));
    Words words{kProgram};
    for (const std::string& word : bench("killed", {})) words.push_back(word);
    Process process(words, {folder_.path(), {}, 60.0});
    while (!std::filesystem::exists(folder_.path() / "killed/report.html")) // written after each group
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    process.send(SIGKILL);
    const ProcessResult result = process.wait();
    ASSERT_EQ(result.signal, SIGKILL) << "it had ended before the second group was measured";
    EXPECT_THAT(text("killed/report.html"), HasSubstr("Unfinished: 2 of 4 points are measured"));

    paint("[1, 1, 0.5]");
    std::filesystem::remove(folder_.path() / "killed/bench.lock"); // a killed process leaves the file unlocked
    expectError(2, bench("killed", {"--resume"}), {"the scene quad.json changed", "name another folder"});
    runGood(bench("two", {"--shard", "2/2"}));
    expectError(2, {"bench", "--merge", "one", "two", "-o", "all"}, {"the scene quad.json changed", "every shard"});
    paint("[1, 1, 1]");
    runGood(bench("killed", {"--resume"}));
    EXPECT_THAT(text("killed/report.html"), testing::Not(HasSubstr("Unfinished")));
}

TEST_F(BenchRuns, aFolderInUseIsRefusedAndItsHolderNamed) {
    runGood(shortCommand("out"));
    const validation::FolderLock held(path("out"));
    const Words parts{"out is in use", fmt::format("process {}", ::getpid()), "name another folder"};
    expectError(1, shortCommand("out"), parts);
    expectError(1, shortCommand("out", {"--resume"}), parts);
    runGood(shortCommand("whole"));
    expectError(1, {"bench", "--merge", "whole", "-o", "out"}, parts);
}

} // namespace
} // namespace tessera::test
