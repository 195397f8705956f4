#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/FramePattern.h"
#include "apps/FrameRange.h"
#include "apps/Shard.h"
#include "base/Error.h"
#include "tests/support/ErrorText.h"

namespace tessera::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string wordsOfRefusal(const auto& action) {
    return test::errorText<InputError>(action);
}

std::vector<int> framesOf(const std::string& text) {
    const FrameRange range = frameRangeNamed(text);
    std::vector<int> frames;
    for (std::size_t place = 0; place < range.count(); ++place) frames.push_back(range.frame(place));
    return frames;
}

TEST(FramePattern, aNumberTakesThePlace) {
    EXPECT_EQ(FramePattern("f_%04d.png").path(7), "f_0007.png");
    EXPECT_EQ(FramePattern("f_%04d.png").path(12345), "f_12345.png");
    EXPECT_EQ(FramePattern("%d.exr").path(0), "0.exr");
    EXPECT_EQ(FramePattern("a/b/%02dx.exr").path(3), "a/b/03x.exr");
    EXPECT_EQ(FramePattern("f%09d.png").path(1), "f000000001.png");
    EXPECT_EQ(FramePattern("a/f_%04d.png").pathWith("frames"), "a/f_frames.png");
}

TEST(FramePattern, aFolderMayBeCalledAnything) {
    EXPECT_EQ(FramePattern("100%/%d/f%d.png").path(5), "100%/%d/f5.png");
}

TEST(FramePattern, anythingButOnePlaceIsRefusedWithAnExample) {
    for (const char* pattern : {"a.png", "a_%d_%d.png", "a_%x.png", "a_%4d.png", "a_%012d.png", "a%%_%d.png",
                                "100%_%d.png", "%d/a.png", "a%", ""}) {
        const std::string refusal = wordsOfRefusal([&] { FramePattern{pattern}; });
        EXPECT_THAT(refusal, HasSubstr("as in f_%04d.png")) << pattern;
        EXPECT_TRUE(refusal.starts_with(std::string(pattern) + ": ")) << refusal;
    }
}

TEST(FrameRange, oneNumberCountsFramesAndTwoAreTheFirstAndTheLast) {
    EXPECT_THAT(framesOf("3"), ElementsAre(0, 1, 2));
    EXPECT_THAT(framesOf("5:7"), ElementsAre(5, 6, 7));
    EXPECT_THAT(framesOf("7:7"), ElementsAre(7));
    EXPECT_THAT(framesOf("0:10:4"), ElementsAre(0, 4, 8));
    EXPECT_THAT(framesOf("0:8:4"), ElementsAre(0, 4, 8));
    EXPECT_THAT(framesOf("5:6:2147483647"), ElementsAre(5));
}

TEST(FrameRange, theLargestNumbersDoNotOverflow) {
    const int most = std::numeric_limits<int>::max();
    EXPECT_THAT(framesOf("2147483646:2147483647"), ElementsAre(most - 1, most));
    EXPECT_THAT(framesOf("0:2147483647:2147483647"), ElementsAre(0, most));
    EXPECT_EQ(frameRangeNamed("1000000").count(), 1000000u);
    EXPECT_EQ(frameRangeNamed("5:1000004").count(), 1000000u);
    EXPECT_THAT(wordsOfRefusal([] { frameRangeNamed("0:2147483647"); }), HasSubstr("more than 1000000 pictures"));
    EXPECT_THAT(wordsOfRefusal([] { frameRangeNamed("0:1000000"); }), HasSubstr("such as 0:999999"));
}

TEST(FrameRange, whatIsNoRangeIsRefused) {
    for (const char* text : {"", "x", "1.5", ":", "1:", ":3", "1:2:", "1:2:3:4", "1-3", " 3", "3 ", "99999999999"})
        EXPECT_THAT(wordsOfRefusal([&] { frameRangeNamed(text); }),
                    HasSubstr("--frames '" + std::string(text) + "' is not a whole number"));
    const std::pair<const char*, const char*> kRefused[] = {
        {"0", "--frames 0 is less than one picture; give 1 or more"},
        {"2147483648", "no number is above 2147483647"},
        {"-1:2", "--frames -1:2: frames are counted from 0"},
        {"5:4", "--frames 5:4 ends before it begins"},
        {"0:4:0", "the step is less than 1; give 1 or more"},
        {"0:4:-1", "the step is less than 1; give 1 or more"}};
    for (const auto& [text, why] : kRefused)
        EXPECT_THAT(wordsOfRefusal([text = text] { frameRangeNamed(text); }), HasSubstr(why));
}

TEST(Shard, everyPieceBelongsToExactlyOne) {
    EXPECT_TRUE(shardNamed("").has(0));
    for (const int count : {1, 2, 3, 7}) {
        for (std::size_t piece = 0; piece < 20; ++piece) {
            int owners = 0;
            for (int index = 1; index <= count; ++index)
                owners += shardNamed(std::to_string(index) + "/" + std::to_string(count)).has(piece) ? 1 : 0;
            EXPECT_EQ(owners, 1) << piece << " of " << count;
        }
    }
    EXPECT_TRUE(shardNamed("1/3").has(0));
    EXPECT_TRUE(shardNamed("3/3").has(5));
    for (const char* text : {"0/2", "3/2", "1/0", "1", "/2", "1/", "x", "1/2/3", "-1/2", "1/10001"})
        EXPECT_THAT(wordsOfRefusal([&] { shardNamed(text); }), HasSubstr("--shard " + std::string(text) + ": give"));
}

} // namespace
} // namespace tessera::app
