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

/// A viewer in a window that fills a screen of 1280 x 800 pixels, or of the size in TESSERA_TEST_SCREEN, and the
/// command line to compare with. Nothing here calls the viewer's code: it is driven by X11 events, and checked by the
/// screen, its saved files and its event log.
class ViewerTest : public testing::Test {
protected:
    /// Sections of the panels, from the top, for a scene without animation.
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

    /// Puts the pointer over the image before a viewer starts, so that no tooltip appears.
    void SetUp() override {
        desktop_->xdotool({"mousemove", std::to_string(middlePixel().x), std::to_string(middlePixel().y)});
    }

    /// Width of the panels at the left; the image begins there.
    static constexpr int kPanelPixels = 300;
    static constexpr glm::ivec2 kPictureCorner{kPanelPixels, 0};
    static glm::ivec2 screenPixels();
    /// A position in the image.
    static glm::ivec2 middlePixel() { return {(kPanelPixels + screenPixels().x) / 2, screenPixels().y / 2 - 10}; }

    /// The scene with the field of view that its camera is made for, whatever the window's shape.
    static inline const std::vector<std::string> kSpheres{"spheres", "--fov", "40"};
    /// Position of the sphere of metalness 0/4 and roughness 4/10 in an image of kSpheres.
    static glm::ivec2 sphereIn(glm::ivec2 sizePixels) {
        return kPictureCorner + sizePixels / 2 + glm::ivec2(-70, 71) * sizePixels.y / 778;
    }

    /// Opens a viewer that fills the screen. Windows are 1280x800 by default if the screen is large enough.
    DrivenViewer open(std::vector<std::string> arguments, const std::map<std::string, std::string>& environment = {}) {
        if (screenPixels().x > 1280)
            for (const std::string& word :
                 {std::string("--window"), fmt::format("{}x{}", screenPixels().x, screenPixels().y)})
                arguments.push_back(word);
        return DrivenViewer(*desktop_, folder_.path(), arguments, environment);
    }
    /// Opens a scene with a rectangle light in the image's centre, 5 m ahead and viewed edge-on. The image covers 5 m
    /// of height there.
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
    /// The image in the window, of the size that the viewer drew.
    static Shot pictureIn(const DrivenViewer& viewer, glm::ivec2 sizePixels) {
        return viewer.capture().part(kPictureCorner, sizePixels);
    }
    /// The whole image after an action, once nothing more is drawn.
    template <class Action>
    static Shot after(const DrivenViewer& viewer, Action act) {
        const std::size_t mark = viewer.mark();
        act();
        return pictureIn(viewer, viewer.waitForWhole(mark));
    }

    // ---- Panels ----
    /// Vertical position in the window of the centre of a section's bar, wherever it is now.
    static int barOf(const DrivenViewer& viewer, Section section);
    /// A position in a row of an open section; the first row below its bar is 1.
    static glm::ivec2 inRow(const DrivenViewer& viewer, Section section, int row, int x) {
        return {x, barOf(viewer, section) + row * kRowPixels};
    }
    /// Vertical positions in the window of an open section's text lines at the left, most of them labels, as far as the
    /// section is visible. Omits greyed text.
    static std::vector<int> linesOf(const DrivenViewer& viewer, Section section);
    /// Opens or closes a section, and leaves the panels unscrolled.
    static void toggle(const DrivenViewer& viewer, Section section);
    /// Closes the open sections, so that opening another one scrolls nothing.
    static void makeRoom(const DrivenViewer& viewer);
    /// Calls makeRoom(), then selects the material of sphereIn() by a click, which opens the section of materials.
    static void pickSphere(const DrivenViewer& viewer, glm::ivec2 sizePixels);
    /// Opens the section of lights, and adds one.
    static void addLight(const DrivenViewer& viewer);
    /// The switch and the name of a light in the list of the open section of lights, which must not be scrolled.
    static glm::ivec2 lightSwitch(const DrivenViewer& viewer, int light) { return {17, lightY(viewer, light)}; }
    static glm::ivec2 lightName(const DrivenViewer& viewer, int light) { return {120, lightY(viewer, light)}; }
    /// A position in a row of the selected light's editor; row 1 is the first below the list of this many lights.
    static glm::ivec2 inLightRow(const DrivenViewer& viewer, int row, int x, int lights = 1) {
        constexpr int kBarePixels = 46; // from the centre of the bar, including the buttons and titles of the list
        return {x, barOf(viewer, Section::Lights) + kBarePixels + lights * kLightPixels + row * kRowPixels};
    }
    /// Chooses an entry of the list of scenes: the built-in ones, then the recent files.
    static void chooseScene(const DrivenViewer& viewer, std::string_view builtin);
    static void chooseRecentScene(const DrivenViewer& viewer, int index);
    static constexpr int kRowPixels = 24;
    static constexpr int kLightPixels = 23; ///< height of a row in the list of lights

    /// Saves the scene with its edits, and dismisses the message about it; returns the file's name.
    static std::string saveScene(const DrivenViewer& viewer);
    nlohmann::json readJson(const std::string& name) const;
    /// Runs a shell script in which "tessera" is the program; expects success and returns stdout.
    std::string shell(const std::string& script) const;
    /// Arguments of `render` for a built-in scene as the viewer opens it at an image size. Cameras are made for 16:9; a
    /// narrower image gets a taller field of view that keeps their width.
    static std::string asOpened(const std::string& builtin, glm::ivec2 sizePixels);
    /// The display image that `tessera render` writes.
    Shot rendered(const std::string& arguments, glm::ivec2 sizePixels) const;
    /// The file's name after "saved " in a line of the log.
    static std::string savedFile(const std::string& line) { return line.substr(line.find(' ') + 1); }
    Picture exr(const std::string& name) const;
    /// Saves the displayed radiance, in a comparison that of the side that the panels control, and dismisses the
    /// message about it.
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
