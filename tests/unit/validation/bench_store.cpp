#include "validation/bench/BenchStore.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/support/TempFolder.h"
#include "tests/unit/validation/Benches.h"
#include "validation/bench/BenchMerge.h"

namespace tessera::validation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BenchStoring : public testing::Test {
protected:
    std::string folder(const std::string& name) const {
        const fs::path path = folder_.path() / name;
        fs::create_directory(path);
        return path.string();
    }

    static GroupState finished(int group) {
        GroupState state;
        state.roundsMs = {{1.0, 2.0 / 3.0}};
        state.group = madeUpGroup(10 << group, {madeUpResult("forward", 10.0 + group, 1e-9)});
        state.isDone = true;
        return state;
    }

    /// Writes a shard with all its groups measured and returns its folder.
    std::string finishedShard(const std::string& name, int shard, int shards, int groups) const {
        const BenchStore store(folder(name), madeUpIdentity(shard, shards), madeUpPlan(groups), EarlierRun::Keep);
        for (int i = 0; i < groups; ++i)
            if (store.isOfShard(std::size_t(i))) store.keep(std::size_t(i), finished(i));
        return folder(name);
    }

    test::TempFolder folder_;
};

TEST_F(BenchStoring, savedResultsAreReadBackAfterTheProgramsEnd) {
    const std::string out = folder("out");
    GroupState half = finished(1);
    half.isDone = false;
    {
        const BenchStore store(out, madeUpIdentity(), madeUpPlan(3), EarlierRun::Keep);
        store.keep(0, finished(0));
        store.keep(1, half);
    }
    const BenchStore store(out, madeUpIdentity(), madeUpPlan(3), EarlierRun::Resume);
    EXPECT_TRUE(store.load(0).isDone);
    EXPECT_FALSE(store.load(1).isDone);
    EXPECT_EQ(store.load(1).roundsMs, half.roundsMs);
    EXPECT_EQ(store.load(1).group.results.size(), 1u);
    EXPECT_TRUE(store.load(2).roundsMs.empty());
    EXPECT_FALSE(recordIn(out).isComplete);
    EXPECT_EQ(recordIn(out).groups.size(), 2u);
}

TEST_F(BenchStoring, anUnfinishedRunIsNotOverwrittenWithoutRequest) {
    const std::string out = folder("out");
    { const BenchStore store(out, madeUpIdentity(), madeUpPlan(2), EarlierRun::Keep); }
    EXPECT_THAT(
        test::errorText<InputError>([&] { BenchStore(out, madeUpIdentity(), madeUpPlan(2), EarlierRun::Keep); }),
        testing::AllOf(HasSubstr("resume it"), HasSubstr("parts")));
    finishedShard("done", 1, 1, 2);
    EXPECT_NO_THROW(BenchStore(folder("done"), madeUpIdentity(), madeUpPlan(2), EarlierRun::Keep));
}

TEST_F(BenchStoring, anotherRunIsNotResumedAndTheDifferenceIsNamed) {
    const std::string out = finishedShard("out", 1, 2, 2);
    const auto resumed = [&](const RunIdentity& identity, const BenchPlan& plan) {
        return test::errorText<InputError>([&] { BenchStore(out, identity, plan, EarlierRun::Resume); });
    };
    RunIdentity other = madeUpIdentity(1, 2);
    other.machine = "64 x Chip";
    EXPECT_THAT(resumed(other, madeUpPlan(2)), testing::AllOf(HasSubstr("machine differs"), HasSubstr("64 x Chip")));
    other = madeUpIdentity(1, 2);
    other.commit = "def";
    EXPECT_THAT(resumed(other, madeUpPlan(2)), HasSubstr("commit differs"));
    other = madeUpIdentity(1, 2);
    other.settings = "";
    EXPECT_THAT(resumed(other, madeUpPlan(2)), HasSubstr("settings differs"));
    EXPECT_THAT(resumed(madeUpIdentity(1, 2), madeUpPlan(3)), HasSubstr("scenes or matrix differ"));
    EXPECT_THAT(resumed(madeUpIdentity(2, 2), madeUpPlan(2)), HasSubstr("holds shard 1/2, not 2/2"));
    other = madeUpIdentity(1, 2);
    other.command = "another spelling of it";
    EXPECT_EQ(resumed(other, madeUpPlan(2)), "");
}

TEST_F(BenchStoring, aSceneWhoseNameIsNotUtf8IsKeptAndResumed) {
    const std::string out = folder("out");
    BenchPlan plan = madeUpPlan(1);
    RunIdentity identity = madeUpIdentity();
    plan.groups[0].scene = "caf\xe9.gltf";
    identity.settings = "--environment caf\xe9.hdr";
    GroupState state = finished(0);
    state.group.scene = plan.groups[0].scene;
    { BenchStore(out, identity, plan, EarlierRun::Keep).keep(0, state); }
    EXPECT_TRUE(BenchStore(out, identity, plan, EarlierRun::Resume).load(0).isDone);
    EXPECT_EQ(recordIn(out).groups.at(0).scene, "caf\xef\xbf\xbd.gltf") << "U+FFFD stands for what is none";
}

TEST_F(BenchStoring, noOtherRunReplacesAShard) {
    const std::string out = finishedShard("a", 1, 2, 2);
    EXPECT_THAT(
        test::errorText<InputError>([&] { BenchStore(out, madeUpIdentity(2, 2), madeUpPlan(2), EarlierRun::Keep); }),
        testing::AllOf(HasSubstr("holds shard 1/2, which shard 2/2 would replace"), HasSubstr("another folder")));
    for (const glm::ivec2 other : {glm::ivec2(1, 1), {1, 3}, {2, 3}})
        EXPECT_THAT(test::errorText<InputError>(
                        [&] { BenchStore(out, madeUpIdentity(other.x, other.y), madeUpPlan(2), EarlierRun::Keep); }),
                    HasSubstr("holds shard 1/2"));
    EXPECT_NO_THROW(BenchStore(out, madeUpIdentity(1, 2), madeUpPlan(2), EarlierRun::Keep));
}

TEST_F(BenchStoring, aChangedSceneIsNotMixedWithItsEarlierState) {
    const std::string a = finishedShard("a", 1, 2, 2);
    BenchPlan changed = madeUpPlan(2);
    changed.groups[1].fingerprint ^= 1;
    EXPECT_THAT(test::errorText<InputError>([&] { BenchStore(a, madeUpIdentity(1, 2), changed, EarlierRun::Resume); }),
                testing::AllOf(HasSubstr("the scene hall changed between them"), HasSubstr("name another folder")));
    {
        const BenchStore store(folder("b"), madeUpIdentity(2, 2), changed, EarlierRun::Keep);
        store.keep(1, finished(1));
    }
    EXPECT_THAT(test::errorText<InputError>([&] {
                    mergeRuns({a, folder("b")}, folder("all"));
                }),
                testing::AllOf(HasSubstr("the scene hall changed between them"), HasSubstr("measure every shard")));
}

TEST_F(BenchStoring, aFolderIsNotGivenToTwoRunsAtOnceAndTheHolderIsNamed) {
    const std::string out = folder("out");
    const auto refused = [&](auto&& begin) { return test::errorText<std::runtime_error>(begin); };
    const auto inUse = testing::AllOf(HasSubstr(out + " is in use"), HasSubstr(fmt::format("process {}", ::getpid())),
                                      HasSubstr("name another folder"));
    {
        const BenchStore store(out, madeUpIdentity(), madeUpPlan(1), EarlierRun::Keep);
        for (const EarlierRun earlier : {EarlierRun::Keep, EarlierRun::Resume, EarlierRun::Replace})
            EXPECT_THAT(refused([&] { BenchStore(out, madeUpIdentity(), madeUpPlan(1), earlier); }), inUse);
        EXPECT_THAT(refused([&] { mergeRuns({finishedShard("whole", 1, 1, 1)}, out); }), inUse);
    }
    EXPECT_FALSE(fs::exists(out + "/bench.lock"));
    // The lock file of a killed process does not lock.
    std::ofstream(out + "/bench.lock") << "process 1";
    EXPECT_NO_THROW(BenchStore(out, madeUpIdentity(), madeUpPlan(1), EarlierRun::Resume));
}

TEST_F(BenchStoring, whatNoRunHasMadeIsNeverDeleted) {
    const std::string out = folder("out");
    const fs::path own = folder_.write("out/parts/lamp.json", "mine");
    const auto isRefused =
        testing::AllOf(HasSubstr(own.string() + ": is no file of a bench"), HasSubstr("move it away"));
    for (const EarlierRun earlier : {EarlierRun::Keep, EarlierRun::Resume, EarlierRun::Replace})
        EXPECT_THAT(test::errorText<InputError>([&] { BenchStore(out, madeUpIdentity(), madeUpPlan(1), earlier); }),
                    isRefused);
    EXPECT_THAT(test::errorText<InputError>([&] { mergeRuns({finishedShard("whole", 1, 1, 1)}, out); }), isRefused);
    EXPECT_EQ(fs::file_size(own), 4u);
    fs::remove(own);
    fs::create_directory(fs::path(out) / "parts/group-lamps");
    EXPECT_THAT(
        test::errorText<InputError>([&] { BenchStore(out, madeUpIdentity(), madeUpPlan(1), EarlierRun::Keep); }),
        HasSubstr("parts/group-lamps: is no file"));
    fs::remove(fs::path(out) / "parts/group-lamps");
    // Leftovers of an interrupted merge are deleted.
    for (const char* file : {"group-000.json", "group-000-truth.png", ".tessera-0123456789abcdef.tmp"})
        folder_.write(std::string("out/parts/") + file, "half");
    EXPECT_NO_THROW(BenchStore(out, madeUpIdentity(), madeUpPlan(1), EarlierRun::Keep));
    EXPECT_FALSE(fs::exists(fs::path(out) / "parts/group-000.json"));

    const std::string other = folder("other");
    const fs::path file = folder_.write("other/parts", "mine");
    EXPECT_THAT(
        test::errorText<InputError>([&] { BenchStore(other, madeUpIdentity(), madeUpPlan(1), EarlierRun::Keep); }),
        HasSubstr(file.string() + ": is no file of a bench"));
    EXPECT_EQ(fs::file_size(file), 4u);
}

TEST_F(BenchStoring, aLinkInThePlaceOfTheLockIsNotFollowed) {
    const std::string out = folder("out");
    const fs::path own = folder_.write("own", "mine");
    fs::create_symlink(own, fs::path(out) / "bench.lock");
    try {
        BenchStore(out, madeUpIdentity(), madeUpPlan(1), EarlierRun::Keep);
        FAIL() << "it was followed";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("cannot lock the folder '" + out + "'"));
    }
    EXPECT_EQ(fs::file_size(own), 4u);
}

TEST_F(BenchStoring, mergedShardsEqualOneRun) {
    finishedShard("whole", 1, 1, 3);
    const std::vector<std::string> shards{finishedShard("b", 2, 2, 3), finishedShard("a", 1, 2, 3)};
    mergeRuns(shards, folder("all"));
    const BenchRecord whole = recordIn(folder("whole")), merged = recordIn(folder("all"));
    EXPECT_EQ(benchJson(merged), benchJson(whole));
    EXPECT_TRUE(merged.isComplete);
}

TEST_F(BenchStoring, shardsThatAreNoWholeRunAreNotMerged) {
    const std::string a = finishedShard("a", 1, 2, 3), b = finishedShard("b", 2, 2, 3);
    const auto merged = [&](const std::vector<std::string>& shards) {
        return test::errorText<InputError>([&] { mergeRuns(shards, folder("all")); });
    };
    EXPECT_THAT(merged({a}), HasSubstr("shard 2/2 is missing"));
    EXPECT_THAT(merged({a, b, a}), HasSubstr("both shard 1/2"));
    EXPECT_THAT(merged({a, finishedShard("c", 2, 3, 3)}), HasSubstr("different numbers of shards"));
    EXPECT_THAT(merged({a, finishedShard("d", 2, 2, 4)}), HasSubstr("scenes or matrix differ"));
    EXPECT_THAT(merged({a, folder("nothing")}), HasSubstr("holds no bench"));
    { const BenchStore begun(folder("e"), madeUpIdentity(2, 2), madeUpPlan(3), EarlierRun::Keep); }
    EXPECT_THAT(merged({a, folder("e")}), HasSubstr("is not finished"));
    EXPECT_THAT(test::errorText<InputError>([&] { mergeRuns({a, b}, a); }), HasSubstr("cannot be written over"));
    EXPECT_EQ(merged({a, b}), "");
}

TEST_F(BenchStoring, damagedFilesAreNamedWithARemedyInWordsOfOurOwn) {
    const std::string out = finishedShard("out", 1, 1, 1);
    const auto read = [&](const std::string& file, const std::string& text) {
        std::ofstream(out + "/parts/" + file) << text;
        const std::string said = test::errorText<InputError>([&] { recordIn(out); });
        EXPECT_THAT(said, testing::AllOf(HasSubstr(file), testing::Not(HasSubstr("json.exception")),
                                         testing::Not(HasSubstr("\n"))));
        return said;
    };
    const auto whole = HasSubstr("is damaged: it is no whole JSON document; remove");
    const auto field = HasSubstr("is damaged: a field is missing or of another kind than tessera writes; remove");
    for (const char* text : {"", "{\"done\": tr", "[1]]"}) EXPECT_THAT(read("group-000.json", text), whole) << text;
    for (const char* text : {"{\"done\": true, \"roundsMs\": []}", "[]", "{\"done\": 1}"})
        EXPECT_THAT(read("group-000.json", text), field) << text;
    EXPECT_THAT(read("group-000.json", "{}"), HasSubstr("resume the bench"));
    GroupState large = finished(0);
    large.group.triangles = 12345;
    BenchStore(out, madeUpIdentity(1, 1), madeUpPlan(1), EarlierRun::Resume).keep(0, large);
    std::ifstream written(out + "/parts/group-000.json");
    std::string group{std::istreambuf_iterator<char>(written), std::istreambuf_iterator<char>()};
    EXPECT_THAT(read("group-000.json", group.replace(group.find("12345"), 5, "1e58")),
                HasSubstr("1e+58 is no whole number from 0 to"));
    std::ifstream kept(out + "/parts/run.json");
    const std::string run{std::istreambuf_iterator<char>(kept), std::istreambuf_iterator<char>()};
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = run;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(read("run.json", changed("\"abc\"", "3")), field);
    EXPECT_THAT(read("run.json", changed("\"hall\"", "null")), field);
    EXPECT_THAT(read("run.json", changed("{", "{\"isShare\": \"yes\",")), field);
    EXPECT_THAT(read("run.json", changed("\"shard\": [\n  1", "\"shard\": [\n  0")),
                HasSubstr("0 is no whole number from 1 to 1"));
    EXPECT_THAT(read("run.json", changed("\"shard\": [\n  1,\n  1", "\"shard\": [\n  1,\n  2147483647")),
                HasSubstr("2147483647 is no whole number from 1 to 10000"));
    EXPECT_THAT(read("run.json", changed("\"frames\": ", "\"frames\": 1e300, \"more\": ")),
                HasSubstr("1e+300 is no whole"));
    const std::string deep(100'000, '[');
    EXPECT_THAT(read("run.json", changed("{", "{\"x\": " + deep + std::string(deep.size(), ']') + ",")),
                HasSubstr("nests"));
    EXPECT_THAT(read("run.json", changed("\"schema\": 7", "\"schema\": 3")), HasSubstr("another version of tessera"));
    EXPECT_THAT(read("run.json", "{"), testing::AllOf(whole, HasSubstr("to measure all of it again")));
}

TEST_F(BenchStoring, picturesAreFilesOfTheirRunAndAreThereBeforeShardsAreMerged) {
    const auto shardWith = [&](const std::string& name, const std::string& picture) {
        const BenchStore store(folder(name), madeUpIdentity(1, 1), madeUpPlan(1), EarlierRun::Keep);
        GroupState state = finished(0);
        state.group.pictures.emplace_back().file = picture;
        store.keep(0, state);
        return folder(name);
    };
    std::ofstream(folder("secret") + "/notes.txt") << "private";
    const std::string outside = shardWith("outside", "../../secret/notes.txt");
    EXPECT_THAT(test::errorText<InputError>([&] { recordIn(outside); }),
                HasSubstr("is no name of a picture beside it"));
    EXPECT_THAT(test::errorText<InputError>([&] { mergeRuns({outside}, folder("all")); }),
                HasSubstr("is no name of a picture beside it"));
    const std::string incomplete = shardWith("incomplete", "group-000-truth.png");
    EXPECT_THAT(test::errorText<InputError>([&] { mergeRuns({incomplete}, folder("all")); }),
                testing::AllOf(HasSubstr(incomplete), HasSubstr("group-000-truth.png"), HasSubstr("is missing")));
    EXPECT_TRUE(fs::is_empty(folder("all")));
}

TEST_F(BenchStoring, otherFilesAndFoldersInAShardAreNotMerged) {
    const std::string shard = finishedShard("shard", 1, 1, 1);
    fs::create_directory(shard + "/parts/folder");
    std::ofstream(shard + "/parts/notes.txt") << "private";
    mergeRuns({shard}, folder("all"));
    EXPECT_FALSE(fs::exists(folder("all") + "/parts/folder"));
    EXPECT_FALSE(fs::exists(folder("all") + "/parts/notes.txt"));
}

} // namespace
} // namespace tessera::validation
