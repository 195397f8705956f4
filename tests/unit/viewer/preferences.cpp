#include <fstream>

#include <gtest/gtest.h>

#include "base/Error.h"
#include "tests/support/TempFolder.h"
#include "viewer/session/Preferences.h"

namespace tessera::viewer {
namespace {

Preferences everything() {
    Preferences preferences;
    preferences.recent = {"/a/b.glb", "/c \"d\".json"};
    preferences.windowSize = glm::ivec2(900, 700);
    preferences.settings["technique"] = "forward_plus";
    preferences.settings["layout"] = "packed";
    preferences.settings["culling"] = "zbin";
    preferences.settings["toneMap"] = "agx";
    preferences.settings["tile"] = "32";
    preferences.settings["samples"] = "4";
    preferences.automaticScale = false;
    preferences.fixedScale = 0.25f;
    preferences.showsPanel = false;
    preferences.panelWidth = 412.0f;
    preferences.sections = {{"Lights", true}, {"View", false}};
    preferences.showsMarkers = true;
    return preferences;
}

TEST(Preferences, writtenPreferencesAreReadBack) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "made" / "viewer.json";
    writePreferences(everything(), file);
    EXPECT_EQ(readPreferences(file), everything());
    writePreferences({}, file);
    EXPECT_EQ(readPreferences(file), Preferences());
}

TEST(Preferences, withoutAFileTheyAreTheUsualOnes) {
    const tessera::test::TempFolder folder;
    EXPECT_EQ(readPreferences(folder.path() / "viewer.json"), Preferences());
}

TEST(Preferences, anEntryOfTheWrongKindIsLeftOutAlone) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    std::ofstream(file) << R"({"technique": 7, "layout": "slim", "window": [1, 1], "recent": "x", "tile": null})";
    Preferences expected;
    expected.settings["layout"] = "slim";
    EXPECT_EQ(readPreferences(file), expected);
}

TEST(Preferences, aWindowOfNoSizeThatWindowsHaveIsLeftOut) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    for (const char* side : {"0", "-300", "16385", "1e58", "-1e300", "18446744073709551615"}) {
        std::ofstream(file) << R"({"window": [)" << side << ", 720]}";
        EXPECT_EQ(readPreferences(file), Preferences()) << side;
    }
}

TEST(Preferences, aScaleThatCannotBeSetIsNotTakenFromAFile) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    for (const char* scale : {"0", "0.05", "-1", "1.5", "1e300"}) {
        std::ofstream(file) << R"({"fixedScale": )" << scale << "}";
        EXPECT_EQ(readPreferences(file), Preferences()) << scale;
    }
}

TEST(Preferences, panelsThatCannotBeDraggedSoAreAsWideAsUsual) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    for (const char* width : {"0", "219", "-1", "901", "1e300"}) {
        std::ofstream(file) << R"({"panelWidth": )" << width << "}";
        EXPECT_EQ(readPreferences(file), Preferences()) << width;
    }
}

TEST(Preferences, aFileThatIsNoJsonIsAnErrorThatNamesIt) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    std::ofstream(file) << "{\"technique\": ";
    try {
        readPreferences(file);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  file.string() + ": the settings are no JSON object; correct or delete the file");
    }
}

TEST(Preferences, aFolderInTheirPlaceIsAnErrorThatNamesIt) {
    const tessera::test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "viewer.json";
    std::filesystem::create_directory(file);
    try {
        readPreferences(file);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  file.string() + ": is not a regular file, so settings cannot be kept; rename or remove it");
    }
}

TEST(Preferences, theTenLatestFilesAreKeptEachExactlyOnce) {
    std::vector<std::string> recent;
    for (int i = 0; i < 15; ++i) addRecent(recent, std::to_string(i));
    addRecent(recent, "7");
    ASSERT_EQ(recent.size(), 10u);
    EXPECT_EQ(recent[0], "7");
    EXPECT_EQ(recent[1], "14");
    EXPECT_EQ(std::count(recent.begin(), recent.end(), "7"), 1);
}

} // namespace
} // namespace tessera::viewer
