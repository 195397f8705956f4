#include "apps/OutputFolder.h"

#include <gtest/gtest.h>

namespace tessera::app {
namespace {

TEST(OutputFolder, aPicturesNameCannotLeaveTheFolder) {
    EXPECT_EQ(pictureFile("deferred (packed)", ".png"), "deferred_packed.png");
    EXPECT_EQ(pictureFile("../a/b", ".exr"), "_._a_b.exr");
    EXPECT_EQ(pictureFile("", ".png"), "picture.png");
}

TEST(OutputFolder, aLongNameIsCutToOneThatAFileCanHaveAndThatNoOtherHas) {
    const std::string longest(200, 'a'), longer = longest + "\xc3\xbc";
    EXPECT_EQ(pictureFile(longest, ".png"), longest + ".png");
    const std::string cut = pictureFile(longer, ".png");
    EXPECT_LE(cut.size(), 255u);
    EXPECT_TRUE(cut.starts_with(longest)) << cut;
    EXPECT_NE(cut, pictureFile(longest, ".png"));
    EXPECT_NE(cut, pictureFile(longest + "b", ".png"));
    EXPECT_EQ(pictureFile(std::string(199, 'a') + "\xc3\xbc", ".png").substr(0, 200), std::string(199, 'a') + "_");
}

} // namespace
} // namespace tessera::app
