#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "tests/cli/program/Cli.h"
#include "tests/support/Random.h"
#include "tests/support/Sweep.h"

namespace tessera::test {
namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

class FrameSequences : public Cli {
protected:
    FrameSequences() {
        writeQuad(R"({"name": "paint", "model": "lambert"})", "[]");
        writeMoving(3.0);
    }

    /// Writes "moving.json": a square, one a tenth as large in front of it, and a light of this many candela that
    /// circles in front of both and casts shadows.
    void writeMoving(double candela) const {
        folder_.write("moving.json", fmt::format(R"({{"tessera": 1, "include": [
            {{"file": "quad.obj", "name": "square"}},
            {{"file": "quad.obj", "name": "caster", "transform": {{"translation": [0, 0, 0.5], "scale": 0.1}}}}],
            "materials": [{{"name": "paint", "model": "lambert"}}],
            "overrides": [{{"node": "square", "material": "paint"}}, {{"node": "caster", "material": "paint"}}],
            "lights": [{{"type": "point", "position": [0.6, 0, 1], "intensity": {}, "castsShadow": true,
                "animation": {{"type": "orbit", "center": [0, 0, 1], "axis": [0, 0, 1], "periodSeconds": 4}}}}],
            "cameras": [{{"name": "front", "position": [0, 0, 2], "target": [0, 0, 0], "fovYDegrees": 60}}]}})",
                                                 candela));
    }

    static Words command(const Words& more) {
        Words words{"render", "moving.json", "--size", "48x27"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// Frames 3 to 8 at eight per second, in files f_3.exr and so on.
    static Words sixFrames(const Words& more = {}) {
        Words words = command({"--frames", "3:8", "--fps", "8", "-o", "f_%d.exr"});
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    static std::string summary(int drawn, int skipped) {
        return fmt::format("{} frame[s]?: {} drawn, {} skipped{}{}\n", drawn + skipped, drawn, skipped,
                           skipped > 0 ? " [(]finished already[)]" : "", drawn > 0 ? ", median [0-9.e+]+ ms" : "");
    }
    std::map<std::string, std::string> pictures(const std::string& beginning) const {
        std::map<std::string, std::string> found;
        for (const auto& [name, contents] : files())
            if (name.starts_with(beginning) && name.ends_with(".exr")) found[name.substr(beginning.size())] = contents;
        return found;
    }
    /// Compares each frame with a single image in three settings in a whole sweep; else every third frame, with shadow
    /// maps, which renderers keep from frame to frame.
    void expectFramesAreThePicturesOfTheirTimes();
    void expectKillsLeaveNoTrace();
    /// Kills twelve processes in a whole sweep, else four.
    void expectKillsWhileWritingLeaveNoTrace();
};
using FrameSequencesSlow = FrameSequences;

void FrameSequences::expectFramesAreThePicturesOfTheirTimes() {
    const std::vector<Words> looks{
        {"--technique", "forward"},
        {"--technique", "clustered_deferred", "--shadow-filter", "pcf"},
        {"--technique", "tiled_deferred", "--shadow-filter", "hard", "--shadow-resolution", "128"}};
    for (std::size_t i = isWholeSweep() ? 0 : looks.size() - 1; i < looks.size(); ++i) {
        SCOPED_TRACE(i);
        const auto with = [&](Words words) {
            words.insert(words.end(), looks[i].begin(), looks[i].end());
            return words;
        };
        const std::string whole = fmt::format("whole{}_", i), cut = fmt::format("cut{}_", i);
        const auto sequence = [&](const std::string& name, const Words& more) {
            Words words = with(command({"--time", "0.25", "--fps", "8", "-o", name + "%d.exr"}));
            words.insert(words.end(), more.begin(), more.end());
            return runGood(words);
        };
        EXPECT_THAT(sequence(whole, {"--frames", "0:5"}), MatchesRegex(summary(6, 0)));
        EXPECT_THAT(sequence(cut, {"--frames", "0:5", "--shard", "2/2"}), MatchesRegex(summary(3, 0)));
        EXPECT_THAT(sequence(cut, {"--frames", "4:4"}), MatchesRegex(summary(1, 0)));
        EXPECT_THAT(sequence(cut, {"--frames", "0:5:2"}), MatchesRegex(summary(2, 1)));
        const std::map<std::string, std::string> made = pictures(whole);
        ASSERT_EQ(made.size(), 6u);
        EXPECT_TRUE(pictures(cut) == made);
        for (int k = 5; k >= 0; k -= isWholeSweep() ? 1 : 3) {
            runGood(with(command({"--time", fmt::format("{}", 0.25 + k / 8.0), "-o", "single.exr"})));
            EXPECT_TRUE(text("single.exr") == made.at(fmt::format("{}.exr", k))) << "frame " << k;
            if (k > 0) {
                EXPECT_FALSE(made.at(fmt::format("{}.exr", k)) == made.at(fmt::format("{}.exr", k - 1)))
                    << "the light moves";
            }
        }
    }
}

TEST_F(FrameSequences, framesAreThePicturesOfTheirTimesInAnyOrderAndShard) {
    expectFramesAreThePicturesOfTheirTimes();
}
TEST_F(FrameSequencesSlow, framesAreThePicturesOfTheirTimesInAnyOrderAndShard) {
    expectFramesAreThePicturesOfTheirTimes();
}

void FrameSequences::expectKillsLeaveNoTrace() {
    const auto words = [](const std::string& name) { return command({"--frames", "60", "-o", name + "%04d.exr"}); };
    runGood(words("whole_"));
    EXPECT_GT(killedUntilItEnds(words("killed_")), 0);
    EXPECT_EQ(pictures("whole_").size(), 60u);
    EXPECT_TRUE(pictures("killed_") == pictures("whole_"));
    EXPECT_THAT(runGood(words("killed_")), MatchesRegex(summary(0, 60)));
}
TEST_F(FrameSequences, aRunThatIsKilledAnywhereAndStartedAgainGivesTheSameFiles) {
    expectKillsLeaveNoTrace();
}
TEST_F(FrameSequencesSlow, aRunThatIsKilledAnywhereAndStartedAgainGivesTheSameFiles) {
    expectKillsLeaveNoTrace();
}

void FrameSequences::expectKillsWhileWritingLeaveNoTrace() {
    const auto words = [](const std::string& name) { return command({"--frames", "120", "-o", name + "%04d.exr"}); };
    runGood(words("whole_"));
    const std::map<std::string, std::string> whole = pictures("whole_");
    Words killed{kProgram};
    for (const std::string& word : words("killed_")) killed.push_back(word);
    const auto countWritten = [&] {
        return std::ranges::count_if(fs::directory_iterator(folder_.path()), [](const fs::directory_entry& entry) {
            const std::string name = entry.path().filename().string();
            return name.starts_with("killed_") && name.ends_with(".exr");
        });
    };
    Random random(20261127);
    int kills = 0;
    for (int attempt = 0; attempt < (isWholeSweep() ? 12 : 4); ++attempt) {
        const auto before = countWritten();
        const std::chrono::microseconds delay(random.index(40'000));
        SCOPED_TRACE(fmt::format("killed {} us after its first picture", delay.count()));
        Process process(killed, {folder_.path(), {}, 60.0});
        std::atomic<bool> hasEnded = false;
        std::thread killer([&] {
            while (!hasEnded && countWritten() == before) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            std::this_thread::sleep_for(delay);
            try {
                process.send(SIGKILL);
            } catch (const std::runtime_error&) { // it has ended
            }
        });
        const ProcessResult result = process.wait();
        hasEnded = true;
        killer.join();
        for (const auto& [name, bytes] : pictures("killed_")) EXPECT_TRUE(bytes == whole.at(name)) << name;
        if (result.exitCode) {
            EXPECT_EQ(*result.exitCode, 0) << result.err;
            break;
        }
        ++kills;
    }
    EXPECT_GE(kills, 2);
    runGood(words("killed_"));
    EXPECT_TRUE(pictures("killed_") == whole);
    EXPECT_THAT(runGood(words("killed_")), MatchesRegex(summary(0, 120)));
}
TEST_F(FrameSequences, killsAtRandomMomentsOfTheWritingLeaveNoPictureThatIsNotWhole) {
    expectKillsWhileWritingLeaveNoTrace();
}
TEST_F(FrameSequencesSlow, killsAtRandomMomentsOfTheWritingLeaveNoPictureThatIsNotWhole) {
    expectKillsWhileWritingLeaveNoTrace();
}

TEST_F(FrameSequences, onlyWhatIsMissingOrOfOtherSettingsIsDrawn) {
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(6, 0)));
    const std::map<std::string, std::string> first = files(), firstPictures = pictures("f_");
    const fs::file_time_type written = fs::last_write_time(path("f_3.exr"));
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(0, 6)));
    EXPECT_TRUE(files() == first);
    EXPECT_EQ(fs::last_write_time(path("f_3.exr")), written);
    EXPECT_EQ(runGood(sixFrames({"--quiet"})), "");

    fs::remove(path("f_4.exr"));
    folder_.write("f_5.exr", text("f_5.exr").substr(0, 500));
    folder_.write("f_6.exr", "not ours");
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(3, 3)));
    EXPECT_TRUE(pictures("f_") == firstPictures);

    EXPECT_THAT(runGood(sixFrames({"--technique", "forward"})), MatchesRegex(summary(6, 0)));
    EXPECT_THAT(runGood(sixFrames({"--technique", "forward", "--time", "0"})), MatchesRegex(summary(0, 6)))
        << "what is the default changes nothing";
    EXPECT_THAT(runGood(sixFrames({"--technique", "forward", "--time", "0.5"})), MatchesRegex(summary(6, 0)));
    EXPECT_THAT(runGood(sixFrames({"--eye", "0,0,2.5"})), MatchesRegex(summary(6, 0)));
    EXPECT_THAT(runGood(sixFrames({"--technique", "reference"})), MatchesRegex(summary(6, 0)));
    EXPECT_THAT(runGood(sixFrames({"--technique", "reference"})), MatchesRegex(summary(0, 6)));
    writeMoving(4.0);
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(6, 0))) << "another scene";
    writeMoving(3.0);
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(6, 0)));
    EXPECT_TRUE(text("f_8.exr") == first.at("f_8.exr"));
}

TEST_F(FrameSequences, whereNoFrameIsLeftNothingIsSaidOfThePicture) {
    for (const char* technique : {"reference", "forward"}) {
        const Words two{"render", "room",     "--technique", technique, "--size",
                        "16x9",   "--frames", "2",           "-o",      "room_%d.exr"};
        EXPECT_THAT(runGood(two), MatchesRegex("camera 'corner' of 2; --camera takes 'back'\n" + summary(2, 0)));
        EXPECT_THAT(runGood(two), MatchesRegex(summary(0, 2)));
    }
}

TEST_F(FrameSequences, anotherPaceDrawsTheFramesWhoseTimesChange) {
    const auto at = [](const std::string& fps) { return command({"--frames", "4", "--fps", fps, "-o", "f_%03d.png"}); };
    EXPECT_THAT(runGood(at("8")), MatchesRegex(summary(4, 0)));
    EXPECT_THAT(runGood(at("4")), MatchesRegex(summary(3, 1)));
}

TEST_F(FrameSequences, shardsWriteTheirOwnFilesAndNothingIsToBeMerged) {
    const std::map<std::string, std::string> before = files();
    EXPECT_THAT(runGood(sixFrames({"--shard", "2/4"})), MatchesRegex(summary(2, 0)));
    std::map<std::string, std::string> made = files();
    EXPECT_EQ(made.size(), before.size() + 3);
    EXPECT_TRUE(made.contains("f_4.exr") && made.contains("f_8.exr") && made.contains("f_frames.exr.2of4.txt"));
    for (const char* shard : {"1/4", "3/4", "4/4"}) {
        runGood(sixFrames({"--shard", shard}));
        const std::map<std::string, std::string> after = files();
        for (const auto& [name, contents] : made) EXPECT_TRUE(after.at(name) == contents) << name;
        made = after;
    }
    EXPECT_THAT(runGood(sixFrames({"--shard", "1/4"})), MatchesRegex(summary(0, 2)));
    EXPECT_THAT(runGood(sixFrames()), MatchesRegex(summary(0, 6)));
    EXPECT_THAT(runGood(command({"--frames", "1", "-o", "g_%d.exr", "--shard", "2/2"})), MatchesRegex(summary(0, 0)));
}

TEST_F(FrameSequences, namesThatCannotBeAreFoundBeforeTheFirstFrame) {
    // The name of frame 9 has 255 bytes, the most that file systems support.
    const std::string name = std::string(250, 'f') + "%d.png";
    expectError(1, command({"--frames", "9:10", "-o", name}), {"10.png: File name too long; give a shorter one"});
    fs::create_symlink("/dev/null", path("f_frames.png.txt"));
    expectError(2, command({"--frames", "2", "-o", "f_%d.png"}), {"f_frames.png.txt: is no file that can record"});
}

TEST_F(FrameSequences, theJournalIsAnOutputToo) {
    folder_.write("f_frames.png.txt/keep", "");
    expectError(1, command({"--frames", "2", "-o", "f_%d.png"}), {"f_frames.png.txt", "folder"});
    folder_.write("deep.json", R"({"tessera": 1, "include": [{"file": "builtin:room"}]})");
    fs::create_symlink("deep.json", path("g_frames.png.txt"));
    expectError(2, {"render", "deep.json", "--frames", "2", "-o", "g_%d.png"},
                {"g_frames.png.txt", "is read for this"});
}

} // namespace
} // namespace tessera::test
