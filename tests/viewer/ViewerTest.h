#pragma once
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/Picture.h"
#include "tests/support/Process.h"
#include "tests/support/TempFolder.h"
#include "tests/viewer/DrivenViewer.h"

namespace tessera::test {

/// A viewer in a window that fills a screen of 1280 x 800 pixels, or of those that TESSERA_TEST_SCREEN says, and the
/// program beside it to compare with. Nothing here calls the viewer's code: it is driven by X11 events, and judged by
/// the screen, its saved files and its event log.
class ViewerTest : public testing::Test {
protected:
    /// Of the panels, from the top, of a scene in which nothing moves.
    enum class Section {
        Scene,
        Lights,
        Materials,
        View,
        Environment,
        Camera,
        Save,
        Technique,
        Shadows,
        Subsurface,
        Compare,
        Timings,
        LightCulling,
        Graph
    };

    static void SetUpTestSuite() { desktop_ = std::make_unique<Desktop>(screenPixels()); }
    static void TearDownTestSuite() { desktop_.reset(); }

    /// The pointer begins where nothing explains what it points at: over the picture, before a viewer is there.
    void SetUp() override {
        desktop_->xdotool({"mousemove", std::to_string(middlePixel().x), std::to_string(middlePixel().y)});
    }

    /// Width of the panels at the left; the picture begins there.
    static constexpr int kPanelPixels = 300;
    static constexpr glm::ivec2 kPictureCorner{kPanelPixels, 0};
    static glm::ivec2 screenPixels();
    /// A place in the picture.
    static glm::ivec2 middlePixel() { return {(kPanelPixels + screenPixels().x) / 2, screenPixels().y / 2 - 10}; }

    /// The scene through the field of view that its camera is made for, whatever the window's shape.
    static inline const std::vector<std::string> kSpheres{"spheres", "--fov", "40"};
    /// Where a picture of kSpheres shows the one of metalness 0/4 and roughness 4/10.
    static glm::ivec2 sphereIn(glm::ivec2 sizePixels) {
        return kPictureCorner + sizePixels / 2 + glm::ivec2(-70, 71) * sizePixels.y / 778;
    }

    /// Fills the screen: a window is 1280x800 at first where there is room for it.
    DrivenViewer open(std::vector<std::string> arguments, const std::map<std::string, std::string>& environment = {}) {
        if (screenPixels().x > 1280)
            for (const std::string& word :
                 {std::string("--window"), fmt::format("{}x{}", screenPixels().x, screenPixels().y)})
                arguments.push_back(word);
        return DrivenViewer(*desktop_, folder_.path(), arguments, environment);
    }
    /// A rectangle in the picture's middle, 5 m ahead, of which its edge is seen: the picture shows 5 m of height
    /// there.
    DrivenViewer openPanel() {
        folder_.write("panel.json", R"({
            "tessera": 1,
            "base": {"file": "builtin:room"},
            "lights": [{"name": "panel", "type": "rectangle", "position": [0, 1.5, -2.5], "direction": [0, -1, 0],
                        "along": [1, 0, 0], "width": 2, "height": 0.5, "intensity": 8}],
            "cameras": [{"name": "front", "position": [0, 1.5, 2.5], "target": [0, 1.5, -2.5],
                         "fovYDegrees": 53.13010235415598}]
        })");
        return open({"panel.json"});
    }
    /// What the window shows of the picture, of the size that the viewer drew.
    static Shot pictureIn(const DrivenViewer& viewer, glm::ivec2 sizePixels) {
        return viewer.capture().part(kPictureCorner, sizePixels);
    }
    /// The picture when all has come to rest after an action.
    template <class Action>
    static Shot after(const DrivenViewer& viewer, Action act) {
        const std::size_t mark = viewer.mark();
        act();
        return pictureIn(viewer, viewer.waitForWhole(mark));
    }

    // ---- Panels ----
    /// Height in the window of the middle of a section's bar, wherever it lies now.
    static int barOf(const DrivenViewer& viewer, Section section);
    /// A place in a row of an open section; the first row under its bar is 1.
    static glm::ivec2 inRow(const DrivenViewer& viewer, Section section, int row, int x) {
        return {x, barOf(viewer, section) + row * kRowPixels};
    }
    /// Heights in the window of the middles of an open section's lines of text at the left, labels most of them, as far
    /// as it is in view; without what is greyed.
    static std::vector<int> linesOf(const DrivenViewer& viewer, Section section);
    /// Opens a section, or closes it; nothing is scrolled afterwards.
    static void toggle(const DrivenViewer& viewer, Section section);
    /// Folds what is open, so that nothing scrolls where another section opens.
    static void makeRoom(const DrivenViewer& viewer);
    /// Selects the material of sphereIn() by a click, which opens the panel of materials in the room that it makes.
    static void pickSphere(const DrivenViewer& viewer, glm::ivec2 sizePixels);
    /// Opens the panel of lights, and adds one.
    static void addLight(const DrivenViewer& viewer);
    /// A light of the list in the open panel of lights, which nothing has scrolled: its switch, and its name.
    static glm::ivec2 lightSwitch(const DrivenViewer& viewer, int light) { return {17, lightY(viewer, light)}; }
    static glm::ivec2 lightName(const DrivenViewer& viewer, int light) { return {120, lightY(viewer, light)}; }
    /// A place in a row of the light that is selected, the first one below the list of so many lights being 1.
    static glm::ivec2 inLightRow(const DrivenViewer& viewer, int row, int x, int lights = 1) {
        constexpr int kBarePixels = 46; // from the middle of the bar, with the buttons and the titles of the list
        return {x, barOf(viewer, Section::Lights) + kBarePixels + lights * kLightPixels + row * kRowPixels};
    }
    /// Chooses an entry of the list of scenes: the built-in ones, then the recent files.
    static void chooseScene(const DrivenViewer& viewer, std::string_view builtin);
    static void chooseRecentScene(const DrivenViewer& viewer, int index);
    static constexpr int kRowPixels = 24;
    static constexpr int kLightPixels = 23; ///< of a row in the list of lights

    /// Saves the scene with its edits, and takes the message away that says so; the file's name.
    static std::string saveScene(const DrivenViewer& viewer);
    nlohmann::json readJson(const std::string& name) const;
    /// Runs a line of shell in which "tessera" is the program; expects success and returns stdout.
    std::string shell(const std::string& script) const;
    /// Words of `render` for a built-in scene as the viewer opens it in a picture of a size: cameras are made for 16:9,
    /// and in a narrower picture a taller field of view keeps their width.
    static std::string asOpened(const std::string& builtin, glm::ivec2 sizePixels);
    /// What `tessera render` writes as a display shows it.
    Shot rendered(const std::string& arguments, glm::ivec2 sizePixels) const;
    /// The name after "saved " in a line of the log.
    static std::string savedFile(const std::string& line) { return line.substr(line.find(' ') + 1); }
    Picture exr(const std::string& name) const;
    /// Saves the radiance that is shown, of a comparison that of the side that the panels control, and takes the
    /// message away that says so.
    Picture savedRadiance(const DrivenViewer& viewer) const;

    TempFolder folder_;
    static inline std::unique_ptr<Desktop> desktop_;

private:
    static void scrollToTop(const DrivenViewer& viewer);
    static int lightY(const DrivenViewer& viewer, int light) {
        constexpr int kFirstPixels = 67;
        return barOf(viewer, Section::Lights) + kFirstPixels + light * kLightPixels;
    }
};

} // namespace tessera::test
