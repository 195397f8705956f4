#include "base/Names.h"

#include <array>

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr std::array<std::string_view, 5> kScenes = {"hall", "spheres", "lattice", "room", "head"};

TEST(Names, nearestNameIsSuggested) {
    EXPECT_EQ(suggestNames("hal", kScenes), "did you mean 'hall'?");
    EXPECT_EQ(suggestNames("HALL", kScenes), "did you mean 'hall'?");
    EXPECT_EQ(suggestNames("latice", kScenes), "did you mean 'lattice'?");
    EXPECT_EQ(suggestNames("shperes", kScenes), "did you mean 'spheres'?");
}

TEST(Names, neighboursSwappedCountAsOneEdit) {
    constexpr std::array<std::string_view, 1> kRoom = {"room"};
    EXPECT_EQ(suggestNames("orom", kRoom), "did you mean 'room'?"); // two edits would be too many for four letters
    EXPECT_EQ(suggestNames("oorn", kRoom), "valid are room");
}

TEST(Names, equallyNearNamesAreAllSuggested) {
    constexpr std::array<std::string_view, 2> kTwo = {"tile_8", "tile_16"};
    constexpr std::array<std::string_view, 3> kThree = {"bat", "cat", "hat"};
    EXPECT_EQ(suggestNames("tile_1", kTwo), "did you mean 'tile_8' or 'tile_16'?");
    EXPECT_EQ(suggestNames("at", kThree), "did you mean 'bat', 'cat' or 'hat'?");
}

TEST(Names, aWordCutShortBringsThoseThatBeginWithIt) {
    constexpr std::array<std::string_view, 4> kOptions = {"--output", "--tile", "--clustered-a", "--clustered-b"};
    EXPECT_EQ(suggestNames("--out", kOptions), "did you mean '--output'?");
    EXPECT_EQ(suggestNames("--CLUS", kOptions), "did you mean '--clustered-a' or '--clustered-b'?");
    EXPECT_EQ(suggestNames("--", kOptions), "valid are --output, --tile, --clustered-a, --clustered-b");
}

TEST(Names, aWordThatIsCutShortGoesBeforeOneThatIsFartherThanAnEdit) {
    constexpr std::array<std::string_view, 4> kKeys = {"shadow", "shadows", "shadowSamples", "shadowResolution"};
    EXPECT_EQ(suggestNames("shadowRes", kKeys), "did you mean 'shadowResolution'?"); // three edits from 'shadow'
    EXPECT_EQ(suggestNames("shadowSam", kKeys), "did you mean 'shadowSamples'?");
    EXPECT_EQ(suggestNames("shado", kKeys), "did you mean 'shadow'?") << "one edit, although all begin so";
}

TEST(Names, namesOfMoreThan128BytesAreNotCompared) {
    const std::string most(128, 'a'), more(129, 'a');
    const std::array<std::string_view, 2> names = {most, more};
    EXPECT_EQ(suggestNames(most.substr(1), names), "did you mean '" + most + "'?");
    EXPECT_EQ(suggestNames(more.substr(1) + "b", names), "valid are " + most + ", " + more);
}

TEST(Names, farNamesAreNotSuggestedButListed) {
    EXPECT_EQ(suggestNames("quetzalcoatl", kScenes), "valid are hall, spheres, lattice, room, head");
    EXPECT_EQ(suggestNames("", kScenes), "valid are hall, spheres, lattice, room, head");
    EXPECT_EQ(suggestNames("x", {}), "there are none");
}

} // namespace
} // namespace tessera
