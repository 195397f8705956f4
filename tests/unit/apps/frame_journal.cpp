#include "apps/FrameJournal.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/support/FileSizeLimit.h"
#include "tests/support/TempFolder.h"

namespace tessera::app {
namespace {

constexpr std::uint64_t kSettings = 17, kOthers = 18;

class FrameJournals : public testing::Test {
protected:
    FramePattern pattern() const { return FramePattern((folder_.path() / "f_%02d.png").string()); }
    std::string path(int frame) const { return pattern().path(frame); }
    /// Writes a frame's file, and its line in the shard's journal.
    void finish(int frame, const std::string& text, const Shard& shard = {}) const {
        folder_.write("f_0" + std::to_string(frame) + ".png", text);
        FrameJournal(pattern(), shard)
            .add(path(frame), kSettings, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    bool isFinished(int frame, std::uint64_t settings = kSettings, const Shard& shard = {}) const {
        return FrameJournal(pattern(), shard).isFinished(path(frame), settings);
    }
    std::string journal(const std::string& name) const {
        std::ifstream stream(folder_.path() / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }

    test::TempFolder folder_;
};

TEST_F(FrameJournals, aFrameIsFinishedAsItsSettingsMadeItAndNotOtherwise) {
    EXPECT_FALSE(isFinished(1));
    finish(1, "a picture");
    EXPECT_TRUE(isFinished(1));
    EXPECT_FALSE(isFinished(1, kOthers));
    EXPECT_FALSE(isFinished(2));
    folder_.write("f_02.png", "a picture");
    EXPECT_FALSE(isFinished(2)) << "an unrecorded picture of the same bytes";
    for (const char* other : {"a pict", "a picturE", "", "a picture and more"}) {
        folder_.write("f_01.png", other);
        EXPECT_FALSE(isFinished(1)) << other;
    }
    folder_.write("f_01.png", "a picture");
    EXPECT_TRUE(isFinished(1)) << "it is back";
    std::filesystem::remove(path(1));
    EXPECT_FALSE(isFinished(1));
    std::filesystem::create_directory(path(1));
    EXPECT_FALSE(isFinished(1));
}

TEST_F(FrameJournals, aFileThatAnotherRunReplacedBeforeItWasKilledIsNotFinished) {
    finish(1, "of these settings");
    folder_.write("f_01.png", "of others, killed before the line");
    EXPECT_FALSE(isFinished(1));
    EXPECT_FALSE(isFinished(1, kOthers));
}

TEST_F(FrameJournals, aLineThatWasCutOffIsNoneAndSpoilsNoOther) {
    finish(1, "one");
    finish(2, "two");
    const std::string whole = journal("f_frames.png.txt");
    for (std::size_t kept = 0; kept <= whole.size(); ++kept) {
        folder_.write("f_frames.png.txt", whole.substr(0, kept));
        EXPECT_EQ(isFinished(1), kept + 1 >= whole.size() / 2) << kept; // a line is complete without its newline
        EXPECT_EQ(isFinished(2), kept + 1 >= whole.size()) << kept;
        finish(3, "three");
        EXPECT_TRUE(isFinished(3)) << kept;
        EXPECT_EQ(isFinished(2), kept + 1 >= whole.size()) << kept;
    }
    folder_.write("f_frames.png.txt", std::string("\0\xff\n\n\r\nx", 8));
    EXPECT_FALSE(isFinished(1)) << "of anything";
}

TEST_F(FrameJournals, aShardAppendsToItsOwnAndReadsThoseOfAll) {
    const Shard two{2, 3};
    EXPECT_EQ(FrameJournal::fileOf(pattern(), {}), (folder_.path() / "f_frames.png.txt").string());
    EXPECT_EQ(FrameJournal::fileOf(pattern(), two), (folder_.path() / "f_frames.png.2of3.txt").string());
    finish(1, "one");
    const std::string before = journal("f_frames.png.txt");
    finish(2, "two", two);
    EXPECT_EQ(journal("f_frames.png.txt"), before);
    for (const Shard& reader : {Shard{}, two, Shard{1, 3}, Shard{1, 5}})
        for (const int frame : {1, 2}) EXPECT_TRUE(isFinished(frame, kSettings, reader));
}

TEST_F(FrameJournals, aJournalThatCannotBeWrittenIsAnError) {
    folder_.write("f_frames.png.txt", std::string(999, ' ') + "\n");
    const test::FileSizeLimit fullDisk(1000);
    EXPECT_THAT(
        test::errorText<std::runtime_error>([this] { FrameJournal(pattern(), {}).add(path(1), kSettings, {}); }),
        testing::HasSubstr("f_frames.png.txt: File too large"));
}

TEST_F(FrameJournals, whatIsNoRegularFileIsNoJournal) {
    std::filesystem::create_symlink("/dev/full", folder_.path() / "f_frames.png.txt");
    EXPECT_THAT(test::errorText<InputError>([this] { finish(1, "one"); }),
                testing::HasSubstr("f_frames.png.txt: is no file that can record"));
}

} // namespace
} // namespace tessera::app
