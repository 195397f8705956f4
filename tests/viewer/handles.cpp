// What is dragged in the picture beside the camera: the selected light's handles, and the environment.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerHandles = ViewerTest;

TEST_F(ViewerHandles, aSideAndTheDirectionOfARectangleGoWithThePointer) {
    // A rectangle in the picture's middle, 5 m ahead, of which its edge is seen: the picture shows 5 m of height there.
    folder_.write("panel.json", R"({
        "tessera": 1,
        "base": {"file": "builtin:room"},
        "lights": [{"name": "panel", "type": "rectangle", "position": [0, 1.5, -2.5], "direction": [0, -1, 0],
                    "along": [1, 0, 0], "width": 2, "height": 0.5, "intensity": 8}],
        "cameras": [{"name": "front", "position": [0, 1.5, 2.5], "target": [0, 1.5, -2.5],
                     "fovYDegrees": 53.13010235415598}]
    })");
    DrivenViewer viewer = open({"panel.json"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const double pixelsPerMetre = size.y / 5.0;
    const glm::ivec2 middle = kPictureCorner + size / 2;
    const auto saved = [&] {
        const std::size_t mark = viewer.mark();
        viewer.key("ctrl+s");
        const std::string file = savedFile(viewer.waitFor("saved ", mark));
        viewer.key("Escape");
        viewer.pause(0.3);
        return nlohmann::json::parse(shell("cat '" + file + "'")).at("lights").at(0);
    };
    const Shot marked = after(viewer, [&] {
        viewer.key("m");
        viewer.click(middle);                           // on the marker: the light is selected
        viewer.drag(middle, middle + glm::ivec2(0, 1)); // of which something is drawn anew
        viewer.drag(middle + glm::ivec2(0, 1), middle);
    });
    const glm::ivec2 side = middle + glm::ivec2(int(pixelsPerMetre), 0), step(80, 0);
    const double stepMetres = step.x / pixelsPerMetre;
    constexpr double kPixelsMetres = 0.02; // three of them
    const Shot wider = after(viewer, [&] { viewer.drag(side, side + step); });
    EXPECT_GT(differingShare(wider, marked, 4), 0.1);
    nlohmann::json light = saved();
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + 2.0 * stepMetres, kPixelsMetres);
    EXPECT_NEAR(light.at("position").at(0).get<double>(), 0.0, kPixelsMetres);
    EXPECT_EQ(light.at("height").get<double>(), 0.5);
    // With Shift the left side stays.
    after(viewer, [&] { viewer.drag(side + step, side, "shift"); });
    light = saved();
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + stepMetres, kPixelsMetres);
    EXPECT_NEAR(light.at("position").at(0).get<double>(), -0.5 * stepMetres, kPixelsMetres);
    // The handle of its direction is 70 pixels under its middle, and goes to the right of that.
    const glm::ivec2 moved = middle - step / 2;
    after(viewer, [&] { viewer.drag(moved + glm::ivec2(0, 70), moved + glm::ivec2(70, 0)); });
    light = saved();
    EXPECT_GT(light.at("direction").at(0).get<double>(), 0.9) << light;
    EXPECT_NEAR(light.at("width").get<double>(), 2.0 + stepMetres, kPixelsMetres);
}

TEST_F(ViewerHandles, theRightButtonWithShiftTurnsTheEnvironment) {
    std::vector<std::string> words = kSpheres;
    for (const char* const word : {"--lights", "0", "--environment", "sky"}) words.emplace_back(word);
    DrivenViewer viewer = open(words);
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 from = kPictureCorner + glm::ivec2(100, before.sizePixels.y / 2);
    const glm::ivec2 half(before.sizePixels.y / 2, 0); // of the picture's height: 90 degrees
    const Shot turned = after(viewer, [&] { viewer.drag(from, from + half, "shift", 3); });
    EXPECT_GT(differingShare(turned, before, 4), 0.1);
    const Shot expected =
        rendered(fmt::format("{} --environment-rotation 90", fmt::join(words, " ")), before.sizePixels);
    // An odd height has no half, and every step of the drag is rounded.
    EXPECT_LT(differingShare(turned, expected, 4), 0.02);
    const Shot back = after(viewer, [&] { viewer.drag(from + half, from, "shift", 3); });
    EXPECT_LT(differingShare(back, before, 4), 0.02);
    // What is saved lies as it is seen.
    after(viewer, [&] { viewer.drag(from, from + half, "shift", 3); });
    const std::size_t mark = viewer.mark();
    viewer.key("ctrl+s");
    const std::string file = savedFile(viewer.waitFor("saved ", mark));
    const nlohmann::json environment = nlohmann::json::parse(shell("cat '" + file + "'")).at("environment");
    EXPECT_NEAR(environment.at("rotationDegrees").get<double>(), 90.0, 1.0) << environment;
}

} // namespace
} // namespace tessera::test
