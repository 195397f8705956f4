// Dragging the selected light's handles and the environment in the image.
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerHandles = ViewerTest;

TEST_F(ViewerHandles, aSideAndTheDirectionOfARectangleGoWithThePointer) {
    DrivenViewer viewer = openPanel();
    const glm::ivec2 size = viewer.waitForWhole(0);
    const double pixelsPerMetre = size.y / 5.0;
    const glm::ivec2 middle = kPictureCorner + size / 2;
    const auto saved = [&] { return readJson(saveScene(viewer)).at("lights").at(0); };
    const Shot marked = after(viewer, [&] {
        viewer.key("m");
        viewer.click(middle);                           // on the marker: selects the light
        viewer.drag(middle, middle + glm::ivec2(0, 1)); // makes the viewer draw again
        viewer.drag(middle + glm::ivec2(0, 1), middle);
    });
    const glm::ivec2 side = middle + glm::ivec2(int(pixelsPerMetre), 0), step(80, 0);
    const double stepMetres = step.x / pixelsPerMetre;
    constexpr double kPixelsMetres = 0.02; // three pixels
    const Shot wider = after(viewer, [&] { viewer.drag(side, side + step); });
    EXPECT_GT(differingShare(wider, marked, 4), 0.1);
    nlohmann::json light = saved();
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + 2.0 * stepMetres, kPixelsMetres);
    EXPECT_NEAR(light.at("position").at(0).get<double>(), 0.0, kPixelsMetres);
    EXPECT_EQ(light.at("height").get<double>(), 0.5);
    // With Shift, the left side stays fixed.
    after(viewer, [&] { viewer.drag(side + step, side, "shift"); });
    light = saved();
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + stepMetres, kPixelsMetres);
    EXPECT_NEAR(light.at("position").at(0).get<double>(), -0.5 * stepMetres, kPixelsMetres);
    // The direction's handle is 70 pixels below the centre, and is dragged to its right.
    const glm::ivec2 moved = middle - step / 2;
    after(viewer, [&] { viewer.drag(moved + glm::ivec2(0, 70), moved + glm::ivec2(70, 0)); });
    light = saved();
    EXPECT_GT(light.at("direction").at(0).get<double>(), 0.9) << light;
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + stepMetres, kPixelsMetres);
}

TEST_F(ViewerHandles, anArmMovesItsLightAlongOneAxisInOneStep) {
    // A lamp in the image's centre, 5 m ahead, where the image covers 5 m of height. Its arm along z is not drawn.
    folder_.write("lamp.json", R"({
        "tessera": 1,
        "base": {"file": "builtin:room"},
        "lights": [{"name": "lamp", "type": "point", "position": [0, 1.5, -2.5], "intensity": 8}],
        "cameras": [{"name": "front", "position": [0, 1.5, 2.5], "target": [0, 1.5, -2.5],
                     "fovYDegrees": 53.13010235415598}]
    })");
    DrivenViewer viewer = open({"lamp.json"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const double pixelsPerMetre = size.y / 5.0;
    const glm::ivec2 middle = kPictureCorner + size / 2;
    const auto savedPosition = [&] {
        return readJson(saveScene(viewer)).at("lights").at(0).at("position").get<std::vector<double>>();
    };
    viewer.key("m");
    viewer.click(middle); // on the marker: selects the light
    viewer.pause(0.5);
    constexpr int kArmPixels = 100, kStepPixels = 80;
    const double stepMetres = kStepPixels / pixelsPerMetre;
    constexpr double kRoundedMetres = 0.02; // three pixels
    // To the right: x. The other saved numbers equal those of the file.
    const glm::ivec2 armX = middle + glm::ivec2(kArmPixels, 0), step(kStepPixels, 0);
    after(viewer, [&] { viewer.drag(armX, armX + step); });
    std::vector<double> position = savedPosition();
    ASSERT_EQ(position.size(), 3u);
    EXPECT_NEAR(position[0], stepMetres, kRoundedMetres);
    EXPECT_EQ(position[1], 1.5);
    EXPECT_EQ(position[2], -2.5);
    const double x = position[0];
    // Upwards: y. Sideways movement of the pointer has no effect.
    const glm::ivec2 armY = middle + step - glm::ivec2(0, kArmPixels);
    after(viewer, [&] { viewer.drag(armY, armY + glm::ivec2(30, -kStepPixels)); });
    position = savedPosition();
    EXPECT_EQ(position[0], x);
    EXPECT_NEAR(position[1], 1.5 + stepMetres, kRoundedMetres);
    EXPECT_EQ(position[2], -2.5);
    after(viewer, [&] { viewer.key("ctrl+z"); });
    EXPECT_EQ(savedPosition(), (std::vector<double>{x, 1.5, -2.5}));
}

TEST_F(ViewerHandles, theRightButtonWithShiftTurnsTheEnvironment) {
    std::vector<std::string> words = kSpheres;
    for (const char* const word : {"--lights", "0", "--environment", "sky"}) words.emplace_back(word);
    DrivenViewer viewer = open(words);
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 from = kPictureCorner + glm::ivec2(100, before.sizePixels.y / 2);
    const glm::ivec2 half(before.sizePixels.y / 2, 0); // half the image's height: 90 degrees
    const Shot turned = after(viewer, [&] { viewer.drag(from, from + half, "shift", 3); });
    EXPECT_GT(differingShare(turned, before, 4), 0.1);
    const Shot expected =
        rendered(fmt::format("{} --environment-rotation 90", fmt::join(words, " ")), before.sizePixels);
    // Half of an odd height is not whole, and every step of the drag is rounded.
    EXPECT_LT(differingShare(turned, expected, 4), 0.02);
    const Shot back = after(viewer, [&] { viewer.drag(from + half, from, "shift", 3); });
    EXPECT_LT(differingShare(back, before, 4), 0.02);
    // Each of the two drags is one step, undone to the last bit.
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+z"); }) == turned);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+z"); }) == before);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+shift+z"); }) == turned);
    // Closing opens a dialog before the edit is lost.
    const std::size_t mark = viewer.mark();
    viewer.key("ctrl+q");
    viewer.waitFor("edits are not saved", mark);
    viewer.pause(0.5);
    viewer.key("Escape");
    viewer.pause(0.5);
    // The saved rotation is the displayed one.
    const nlohmann::json environment = readJson(saveScene(viewer)).at("environment");
    EXPECT_NEAR(environment.at("rotationDegrees").get<double>(), 90.0, 1.0) << environment;
    viewer.key("ctrl+q"); // no question
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

} // namespace
} // namespace tessera::test
