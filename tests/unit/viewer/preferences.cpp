#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
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

class PreferencesFile : public testing::Test {
protected:
    Preferences readFrom(const std::string& text) const {
        std::ofstream(file_) << text;
        return readPreferences(file_);
    }
    std::string fault() const {
        return tessera::test::errorText<InputError>([this] { readPreferences(file_); });
    }

    tessera::test::TempFolder folder_;
    const std::filesystem::path file_ = folder_.path() / "viewer.json";
};

TEST_F(PreferencesFile, writtenPreferencesAreReadBack) {
    const std::filesystem::path file = folder_.path() / "made" / "viewer.json";
    writePreferences(everything(), file);
    EXPECT_EQ(readPreferences(file), everything());
    writePreferences({}, file);
    EXPECT_EQ(readPreferences(file), Preferences());
}

TEST_F(PreferencesFile, withoutAFileTheyAreTheUsualOnes) {
    EXPECT_EQ(readPreferences(file_), Preferences());
}

TEST_F(PreferencesFile, anEntryOfTheWrongKindIsLeftOutAlone) {
    Preferences expected;
    expected.settings["layout"] = "slim";
    EXPECT_EQ(readFrom(R"({"technique": 7, "layout": "slim", "window": [1, 1], "recent": "x", "tile": null})"),
              expected);
}

TEST_F(PreferencesFile, sizesAndScalesThatTheWindowCannotHaveAreLeftOut) {
    for (const char* side : {"0", "-300", "16385", "1e58", "-1e300", "18446744073709551615"})
        EXPECT_EQ(readFrom(fmt::format(R"({{"window": [{}, 720]}})", side)), Preferences()) << side;
    for (const char* scale : {"0", "0.05", "-1", "1.5", "1e300"})
        EXPECT_EQ(readFrom(fmt::format(R"({{"fixedScale": {}}})", scale)), Preferences()) << scale;
    for (const char* width : {"0", "219", "-1", "901", "1e300"})
        EXPECT_EQ(readFrom(fmt::format(R"({{"panelWidth": {}}})", width)), Preferences()) << width;
}

TEST_F(PreferencesFile, whatIsNoJsonOrNoFileIsAnErrorThatNamesIt) {
    std::ofstream(file_) << "{\"technique\": ";
    EXPECT_EQ(fault(), file_.string() + ": the settings are no JSON object; correct or delete the file");
    std::filesystem::remove(file_);
    std::filesystem::create_directory(file_);
    EXPECT_EQ(fault(), file_.string() + ": is not a regular file, so settings cannot be kept; rename or remove it");
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
