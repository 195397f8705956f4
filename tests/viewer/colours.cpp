// A colour is the same in lists, editors, pickers and the image.
#include <cmath>
#include <stdexcept>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerColours : public ViewerTest {
protected:
    static constexpr int kSwatchX = 276; // beside a scroll bar too

    /// Opens a scene of a card that fills the image, with unlit paint, and a lamp in front of its centre.
    DrivenViewer openCard() {
        folder_.write("card.obj", "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
        folder_.write("card.json", R"({"tessera": 1, "include": [{"file": "card.obj"}],
            "materials": [{"name": "paint", "model": "single_color", "color": [0.402, 0.1, 0.3]}],
            "overrides": [{"node": "card", "material": "paint"}],
            "lights": [{"name": "lamp", "type": "point", "position": [0, 0, 0.5], "intensity": 8}],
            "cameras": [{"name": "front", "position": [0, 0, 2], "target": [0, 0, 0], "fovYDegrees": 30}]})");
        return open({"card.json"});
    }
    /// A position on the card beside the lamp that neither a picker nor an outline covers.
    static glm::ivec2 cardPixel() { return screenPixels() - glm::ivec2(60, screenPixels().y / 2); }

    /// Clicks the card, which opens the section of materials; returns the position of its colour swatch.
    static glm::ivec2 pickPaint(const DrivenViewer& viewer) {
        makeRoom(viewer);
        const std::size_t mark = viewer.mark();
        viewer.click(cardPixel());
        EXPECT_EQ(viewer.waitFor("picked ", mark), "picked paint");
        viewer.pause(0.5);
        constexpr int kColourRow = 3;
        return inRow(viewer, Section::Materials, kColourRow, kSwatchX);
    }

    /// The field of hexadecimal digits in the picker that a click on a swatch has opened: the lowest of its fields.
    static glm::ivec2 digitsOf(const DrivenViewer& viewer, glm::ivec2 swatch) {
        constexpr glm::ivec3 kField(13, 13, 14); // the theme's fill colour
        constexpr int kBehindDigits = 150, kLeastHeight = 15;
        for (int tried = 0; tried < 50; ++tried) {
            const Shot shot = viewer.capture();
            const int x = swatch.x + kBehindDigits;
            for (int y = shot.sizePixels.y - 1, height = 0; y >= 0; --y) {
                height = shot.at({x, y}) == kField ? height + 1 : 0;
                if (height == kLeastHeight) return {x, y + kLeastHeight / 2};
            }
            viewer.pause(0.1);
        }
        throw std::runtime_error("a click on a swatch opens no picker with digits");
    }
    /// Types digits into a swatch's picker, after keys that select or delete the old ones, and closes it.
    static void typeDigits(const DrivenViewer& viewer, glm::ivec2 swatch, const std::vector<std::string>& keys,
                           const std::string& digits) {
        viewer.click(swatch);
        viewer.click(digitsOf(viewer, swatch));
        viewer.pause(0.3);
        const std::size_t mark = viewer.mark();
        for (const std::string& key : keys) viewer.key(key);
        viewer.type(digits);
        viewer.key("Return");
        viewer.waitForWhole(mark);
        viewer.key("Escape");
        viewer.moveTo(cardPixel()); // nothing is highlighted and no tooltip appears there
        viewer.pause(0.5);
    }

    static void typeColour(const DrivenViewer& viewer, glm::ivec2 swatch) {
        typeDigits(viewer, swatch, {"ctrl+a"}, "c85a1e");
    }

    /// Number of pixels of exactly this colour in a square around a position.
    static int countAbout(const Shot& shot, glm::ivec2 place, int reachPixels, const glm::ivec3& colour) {
        int count = 0;
        for (int y = place.y - reachPixels; y <= place.y + reachPixels; ++y)
            for (int x = place.x - reachPixels; x <= place.x + reachPixels; ++x)
                count += shot.at({x, y}) == colour ? 1 : 0;
        return count;
    }
    /// Expects a saved colour to be the linear value of sRGB codes. Source: IEC 61966-2-1.
    static void expectLinear(const nlohmann::json& saved, const glm::ivec3& code) {
        ASSERT_GE(saved.size(), 3u) << saved;
        constexpr double kFloat = 1e-6; // precision of a float
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(saved.at(std::size_t(i)).get<double>(), std::pow((code[i] / 255.0 + 0.055) / 1.055, 2.4),
                        kFloat)
                << saved;
    }

    // Swatches in lists are as high as a line of text, 13 pixels, others as a field, 19. They have a border of one
    // pixel and round corners.
    static constexpr int kListSwatchPixels = 11 * 11 - 20, kSwatchPixelsLeast = 17 * 17 - 30, kSwatchReach = 15;
    static constexpr glm::ivec3 kTyped{0xc8, 0x5a, 0x1e}; // typed by typeColour()
};

TEST_F(ViewerColours, aSwatchShowsTheColourThatThePictureShows) {
    DrivenViewer viewer = openCard();
    viewer.waitForWhole(0);
    const glm::ivec3 shown = viewer.capture().at(cardPixel());
    EXPECT_EQ(shown, glm::ivec3(170, 89, 149)) << "sRGB of its linear values";
    const glm::ivec2 swatch = pickPaint(viewer);
    EXPECT_EQ(viewer.capture().at(swatch), shown);
}

TEST_F(ViewerColours, digitsTypedIntoThePickerOfAMaterialAreWhatThePictureAndTheSwatchShow) {
    DrivenViewer viewer = openCard();
    viewer.waitForWhole(0);
    const glm::ivec2 swatch = pickPaint(viewer);
    typeColour(viewer, swatch);
    const Shot shot = viewer.capture();
    EXPECT_EQ(shot.at(cardPixel()), kTyped);
    EXPECT_GE(countAbout(shot, swatch, kSwatchReach, kTyped), kSwatchPixelsLeast) << "the editor's";
    expectLinear(readJson(saveScene(viewer)).at("materials").at(0).at("color"), kTyped);
}

TEST_F(ViewerColours, aDigitTypedIntoThePickerLeavesTheOtherChannelsToTheLastBit) {
    DrivenViewer viewer = openCard();
    viewer.waitForWhole(0);
    typeDigits(viewer, pickPaint(viewer), {"End", "BackSpace"}, "6"); // the last digit of #aa5995
    EXPECT_EQ(viewer.capture().at(cardPixel()), glm::ivec3(170, 89, 150));
    const nlohmann::json color = readJson(saveScene(viewer)).at("materials").at(0).at("color");
    EXPECT_EQ(color.at(0).get<float>(), 0.402f) << color;
    EXPECT_EQ(color.at(1).get<float>(), 0.1f) << color;
    EXPECT_NE(color.at(2).get<float>(), 0.3f) << color;
}

TEST_F(ViewerColours, digitsTypedIntoThePickerOfALightAreTheColourOfItsListEntryItsEditorAndItsMarker) {
    DrivenViewer viewer = openCard();
    const glm::ivec2 size = viewer.waitForWhole(0);
    makeRoom(viewer);
    toggle(viewer, Section::Lights);
    viewer.click(lightName(viewer, 0));
    viewer.pause(0.5);
    constexpr int kLightColourRow = 2;
    const glm::ivec2 swatch = inLightRow(viewer, kLightColourRow, kSwatchX);
    typeColour(viewer, swatch);
    const Shot shot = viewer.capture();
    constexpr int kListSwatchX = 41;
    EXPECT_GE(countAbout(shot, {kListSwatchX, lightName(viewer, 0).y}, kSwatchReach, kTyped), kListSwatchPixels)
        << "the list's";
    EXPECT_GE(countAbout(shot, swatch, kSwatchReach, kTyped), kSwatchPixelsLeast) << "the editor's";
    EXPECT_EQ(shot.at(kPictureCorner + size / 2), kTyped) << "the marker's";
    expectLinear(readJson(saveScene(viewer)).at("lights").at(0).at("color"), kTyped);
}

} // namespace
} // namespace tessera::test
