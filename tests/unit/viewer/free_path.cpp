#include <gtest/gtest.h>

#include "tests/unit/viewer/InEmptyFolder.h"
#include "viewer/session/FreePath.h"

namespace tessera::viewer {
namespace {

class FreePath : public test::InEmptyFolder {};

TEST_F(FreePath, aFileThatIsThereIsNotNamed) {
    EXPECT_EQ(freePath("hall", ".png"), "tessera-hall-001.png");
    folder().write("tessera-hall-001.png", "");
    EXPECT_EQ(freePath("hall", ".png"), "tessera-hall-002.png");
    EXPECT_EQ(freePath("hall", ".exr"), "tessera-hall-001.exr");
    std::filesystem::create_symlink("nowhere", "tessera-hall-002.png");
    EXPECT_EQ(freePath("hall", ".png"), "tessera-hall-003.png");
}

TEST_F(FreePath, aNameIsOneWordOfAShell) {
    EXPECT_EQ(freePath("my model (v2)/$x", ".json"), "tessera-my-model--v2---x-001.json");
}

TEST_F(FreePath, aNameKeepsLettersOfAllLanguagesWhole) {
    const std::string lamp = "\xe7\x81\xaf"; // U+706F
    EXPECT_EQ(freePath(lamp + " a\xc3\xa9\xff", ".json"), "tessera-" + lamp + "-a\xc3\xa9--001.json");
    EXPECT_EQ(freePath("a\xe2\x80\xae\xc2\x85z", ".json"), "tessera-a--z-001.json"); // U+202E, U+0085
    std::string lamps;
    for (int i = 0; i < 50; ++i) lamps += lamp;
    EXPECT_EQ(freePath("x" + lamps, ".json"), "tessera-x" + lamps.substr(0, 117) + "-001.json");
}

TEST_F(FreePath, aNameIsNotLongerThanFileSystemsAllow) {
    EXPECT_LT(freePath(std::string(250, 'x'), ".trace.json").string().size(), 200u);
}

} // namespace
} // namespace tessera::viewer
