#include "viewer/window/Letters.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/ShownText.h"
#include "viewer/window/Fonts.h"

namespace tessera::viewer {
namespace {

using Ranges = std::vector<std::uint16_t>;

TEST(Letters, areThoseOfWesternEuropeAndWhateverOccursEachOnce) {
    Letters letters;
    EXPECT_EQ(letters.ranges(), (Ranges{0x20, 0xff, 0x2010, 0x2026, 0}));
    letters.note("caf\xc3\xa9 \xe2\x80\x93 lamp"); // with an en dash
    EXPECT_FALSE(letters.takeNew()) << "all of them are known";
    letters.note("\xd0\x96\xd0\x97\xd0\x96"); // U+0416, U+0417
    EXPECT_TRUE(letters.takeNew());
    EXPECT_FALSE(letters.takeNew());
    EXPECT_EQ(letters.ranges(), (Ranges{0x20, 0xff, 0x416, 0x417, 0x2010, 0x2026, 0}));
    letters.note("\xd0\x97");
    EXPECT_FALSE(letters.takeNew());
    letters.note("\xc4\x80"); // U+0100 continues the range of Latin-1
    EXPECT_EQ(letters.ranges().at(1), 0x100);
}

TEST(Letters, whatIsNoTextAndWhatHasNoRoomIsLeftOut) {
    Letters letters;
    letters.note("\xff\xc3");
    letters.note("\xf0\x9f\x92\xa1"); // U+1F4A1, a lamp
    EXPECT_FALSE(letters.takeNew());
    EXPECT_FALSE(letters.hasEastAsian());
}

TEST(Letters, ofChineseJapaneseAndKoreanNeedAnotherFont) {
    for (const char* text : {"\xe7\x81\xaf", "\xe3\x81\x82", "\xed\x95\x9c"}) {
        Letters letters;
        letters.note("\xd7\x90 \xce\xb1"); // Hebrew, Greek
        EXPECT_FALSE(letters.hasEastAsian());
        letters.note(text);
        EXPECT_TRUE(letters.hasEastAsian()) << text;
    }
}

class Fonts : public test::PanelTest {
protected:
    /// Returns whether the interface's fonts have this letter without a fallback.
    static bool has(ImWchar letter) {
        ImGui::GetIO().Fonts->Build();
        return std::ranges::all_of(ImGui::GetIO().Fonts->Fonts,
                                   [&](const ImFont* font) { return font->FindGlyphNoFallback(letter) != nullptr; });
    }
};

TEST_F(Fonts, haveTheLettersThatOccur) {
    Letters letters;
    Ranges ranges;
    applyFonts(letters, 13.0f, ranges);
    EXPECT_TRUE(has('A'));
    EXPECT_FALSE(has(0x416));
    letters.note("\xd0\x96");
    applyFonts(letters, 26.0f, ranges);
    EXPECT_TRUE(has('A'));
    EXPECT_TRUE(has(0x416));
    ASSERT_EQ(ImGui::GetIO().Fonts->Fonts.Size, 2) << "of words and of titles";
    EXPECT_EQ(ImGui::GetIO().Fonts->Fonts[1]->FontSize, titlePixels(26.0f));
}

TEST_F(Fonts, areRequestedNamesOfTheSceneAndOfFiles) {
    scenes::Scene scene = scenes::loadScene("room", {});
    scene.lights.at(0).name = "the light";
    scene.materials.at(0).name = "the material";
    scene.warnings = {"the warning"};
    State state = test::stateOf(std::move(scene), {}, "/the/file");
    state.files.emplace(FileDialog::Purpose::Save, "/", "the name");
    state.maps = {"/the/map"};
    std::vector<std::string> texts;
    const TextVisitor note = [&](std::string_view text) { texts.emplace_back(text); };
    visitSceneText(*state.open, note);
    visitShownText(state, note);
    for (const char* text : {"/the/file", "the light", "the material", "the warning", "the name", "/the/map"})
        EXPECT_NE(std::ranges::find(texts, text), texts.end()) << text;
}

} // namespace
} // namespace tessera::viewer
