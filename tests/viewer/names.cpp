// Names in other scripts.
#include <algorithm>
#include <filesystem>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerNames = ViewerTest;

TEST_F(ViewerNames, ofChineseJapaneseAndKoreanHaveTheirLettersInTheListAndInFiles) {
    // Of the fonts that the viewer looks for, those with letters of all three scripts.
    constexpr const char* kFontsOfAll[] = {"/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
                                           "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc"};
    if (std::ranges::none_of(kFontsOfAll, [](const char* file) { return std::filesystem::exists(file); }))
        GTEST_SKIP() << "neither fonts-wqy-microhei nor fonts-noto-cjk is installed";
    constexpr const char* kLamp = "\xe7\x81\xaf"; // U+706F
    // As many names as the list shows, in Chinese, Japanese and Korean; U+1F4A1 is drawn as a replacement sign,
    // whatever fonts are installed.
    const std::vector<std::string> names{kLamp,          "\xe5\x85\x89", "\xe3\x81\x82",
                                         "\xe3\x82\xa2", "\xed\x95\x9c", "\xf0\x9f\x92\xa1"};
    nlohmann::json scene{{"tessera", 1}, {"base", {{"file", "builtin:room"}}}, {"lights", nlohmann::json::array()}};
    for (const std::string& name : names)
        scene["lights"].push_back({{"name", name}, {"type", "point"}, {"position", {0, 1.5, 0}}, {"intensity", 1}});
    const std::string file = std::string(kLamp) + ".json";
    folder_.write("things/" + file, scene.dump());
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    std::size_t mark = viewer.mark();
    viewer.key("ctrl+o");
    viewer.waitFor("shows the open dialog", mark);
    viewer.pause(0.7);
    viewer.type("thi"); // enters the folder
    viewer.pause(0.3);
    viewer.key("Return");
    viewer.pause(0.5);
    mark = viewer.mark();
    for (int i = 0; i < 2; ++i) viewer.key("Down"); // the parent folder, the file
    viewer.pause(0.3);
    viewer.key("Return");
    const std::string opened = viewer.waitFor("opened ", mark);
    EXPECT_NE(opened.find("things/" + file), std::string::npos) << opened;
    viewer.waitForWhole(mark);
    toggle(viewer, Section::Lights);
    // The first letter of each name, right of the light's swatch. Only ink counts: rows differ by less than that.
    constexpr int kLetterX = 52, kInkSteps = 60;
    constexpr glm::ivec2 kLetterPixels(18, 18);
    std::vector<Shot> letters;
    for (int i = 0; i < int(names.size()); ++i) {
        const glm::ivec2 corner(kLetterX, lightName(viewer, i).y - kLetterPixels.y / 2);
        letters.push_back(viewer.capture().part(corner, kLetterPixels));
    }
    const auto ink = [&](const Shot& letter) {
        const glm::ivec3 behind = letter.at({0, 0});
        Shot empty{letter.sizePixels, {}};
        for (int i = 0; i < kLetterPixels.x * kLetterPixels.y; ++i)
            for (int c = 0; c < 3; ++c) empty.rgb.push_back(std::uint8_t(behind[c]));
        return differingShare(letter, empty, kInkSteps);
    };
    for (std::size_t i = 0; i < letters.size(); ++i) {
        SCOPED_TRACE(names[i]);
        EXPECT_GT(ink(letters[i]), 0.03) << "there is no letter";
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(differingShare(letters[i], letters[j], kInkSteps), 0.02) << "it looks like " << names[j];
    }
    // The saved file has the letters too, in its name and its contents.
    viewer.click(lightSwitch(viewer, 1));
    viewer.moveTo(middlePixel());
    const std::string saved = saveScene(viewer);
    EXPECT_TRUE(saved.ends_with("tessera-" + std::string(kLamp) + "-001.json")) << saved;
    const nlohmann::json lights = readJson(saved).at("lights");
    ASSERT_EQ(lights.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(lights.at(i).at("name"), names[i]);
}

} // namespace
} // namespace tessera::test
