// Sizes, minimising, closing, and preferences.
#include <csignal>
#include <optional>

#include "tests/support/AssetsFolder.h"
#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerWindow = ViewerTest;

TEST_F(ViewerWindow, anySizeDownToOnePixelSurvivesAndComesBackWhole) {
    DrivenViewer viewer = open({"room"});
    const Shot first = pictureIn(viewer, viewer.waitForWhole(0));
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(301, 30), glm::ivec2(700, 500), glm::ivec2(2, 700)}) {
        viewer.resize(size);
        viewer.pause(0.4);
    }
    const std::size_t mark = viewer.mark();
    viewer.resize(screenPixels());
    EXPECT_TRUE(pictureIn(viewer, viewer.waitForWhole(mark)) == first);
    viewer.minimise();
    viewer.pause(0.5);
    viewer.restore();
    viewer.pause(1.0);
    EXPECT_TRUE(pictureIn(viewer, first.sizePixels) == first);
    viewer.close();
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
    EXPECT_EQ(viewer.errors(), "");
}

TEST_F(ViewerWindow, closingDuringALoadIsClean) {
    const tessera::test::AssetsFolder none(nullptr); // a scan would be read before the window can be closed
    DrivenViewer viewer = open({"head"});
    viewer.close();
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
    EXPECT_EQ(viewer.errors(), "");
    const std::vector<std::string> lines = viewer.lines();
    EXPECT_EQ(lines, (std::vector<std::string>{"loading head", "closed"})) << "it was closed too late";
}

TEST_F(ViewerWindow, settingsAreRememberedFromRunToRun) {
    {
        DrivenViewer viewer = open({"room"});
        EXPECT_EQ(viewer.waitForWhole(0).x, screenPixels().x - kPanelPixels);
        const std::size_t mark = viewer.mark();
        viewer.key("Tab"); // hides the panels
        viewer.key("t");
        EXPECT_EQ(viewer.waitForWhole(mark).x, screenPixels().x);
        viewer.key("ctrl+q");
        EXPECT_EQ(viewer.wait(), 0);
    }
    DrivenViewer viewer = open({"room"});
    EXPECT_EQ(viewer.waitForWhole(0).x, screenPixels().x);
    EXPECT_NE(viewer.waitFor("drawn", 0).find("technique clustered_forward"), std::string::npos);
}

TEST_F(ViewerWindow, settingsAndRecentFilesAreKeptWhereASignalEndsAViewerWithoutEdits) {
    const std::string file =
        folder_.write("mine.json", R"({"tessera": 1, "base": {"file": "builtin:spheres"}})").string();
    {
        DrivenViewer viewer = open({"mine.json"});
        viewer.waitForWhole(0);
        const std::size_t mark = viewer.mark();
        viewer.key("Tab"); // hides the panels
        viewer.waitForWhole(mark);
        viewer.send(SIGTERM);
        EXPECT_EQ(viewer.wait(), std::nullopt) << "it ends by the signal";
        EXPECT_EQ(viewer.errors(), "");
    }
    EXPECT_EQ(readJson("config/tessera/viewer.json").at("recent"), nlohmann::json::array({file}));
    DrivenViewer viewer = open({"room"});
    EXPECT_EQ(viewer.waitForWhole(0).x, screenPixels().x);
    for (const std::string& line : viewer.lines()) EXPECT_FALSE(line.starts_with("edits were left")) << line;
}

TEST_F(ViewerWindow, settingsOfAViewerThatIsKilledAreThoseOfAFewSecondsBefore) {
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    const std::size_t mark = viewer.mark();
    viewer.key("Tab"); // hides the panels
    viewer.waitForWhole(mark);
    viewer.pause(3.0);
    viewer.send(SIGKILL);
    EXPECT_EQ(viewer.wait(), std::nullopt);
    EXPECT_EQ(readJson("config/tessera/viewer.json").at("showsPanel"), false);
}

TEST_F(ViewerWindow, panelsAreAsWideAndAsFoldedAsTheyWereLeft) {
    int lights = 0;
    {
        DrivenViewer viewer = open({"room"});
        viewer.waitForWhole(0);
        toggle(viewer, Section::Scene);
        lights = barOf(viewer, Section::Lights);
        const std::size_t mark = viewer.mark();
        viewer.drag({kPanelPixels + 1, 300}, {kPanelPixels + 101, 300});
        EXPECT_EQ(viewer.waitForWhole(mark).x, screenPixels().x - kPanelPixels - 101);
        viewer.key("ctrl+q");
        EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
    }
    DrivenViewer viewer = open({"room"});
    EXPECT_EQ(viewer.waitForWhole(0).x, screenPixels().x - kPanelPixels - 101);
    EXPECT_EQ(barOf(viewer, Section::Lights), lights);
}

TEST_F(ViewerWindow, aWindowThatSettingsHoldIsNoLargerThanTheScreen) {
    folder_.write("config/tessera/viewer.json", R"({"window": [16384, 16384]})");
    DrivenViewer viewer = open({"room"});
    const glm::ivec2 pixels = viewer.waitForWhole(0);
    EXPECT_EQ(pixels.x, screenPixels().x - kPanelPixels);
    EXPECT_LE(pixels.y, screenPixels().y) << "a window manager may take a title's height";
    EXPECT_GE(pixels.y, screenPixels().y - 100);
}

TEST_F(ViewerWindow, theReasonOfAFailedLoadIsShown) {
    folder_.write("broken.json", "{\"tessera\": 1, \"materials\": [{\"name\": 3}]}");
    DrivenViewer viewer = open({"broken.json"});
    const std::string said = viewer.waitFor("error ", 0);
    EXPECT_NE(said.find("broken.json"), std::string::npos) << said;
    viewer.pause(1.0);
    // The window shows the reason, and the viewer continues.
    const auto lowerPart = [&] {
        return viewer.capture().part({kPanelPixels, screenPixels().y - 200}, {screenPixels().x - kPanelPixels, 170});
    };
    const Shot message = lowerPart();
    viewer.key("Escape");
    viewer.pause(0.5);
    EXPECT_GT(differingShare(message, lowerPart()), 0.05);
    viewer.key("ctrl+q");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

} // namespace
} // namespace tessera::test
