// A walk through the scene with the most lights, in which every image takes long.
#include "tests/viewer/ViewerTest.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::test {
namespace {

using ViewerHallSlow = ViewerTest;

TEST_F(ViewerHallSlow, aWalkThroughAllOfItsLightsEditsComparesInspectsAndSaves) {
    DrivenViewer viewer = open({"hall", "--technique", "clustered_deferred"});
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 size = home.sizePixels;
    EXPECT_TRUE(home == rendered(asOpened("hall", size) + " --technique clustered_deferred", size));
    // A few degrees: the camera stays in the nave.
    const glm::ivec2 aside = middlePixel() + glm::ivec2(20, 4);
    const Shot turned = after(viewer, [&] { viewer.drag(middlePixel(), aside); });
    EXPECT_GT(differingShare(turned, home, 4), 0.1);

    // The first of the 258 lights is a lamp in the nave.
    makeRoom(viewer);
    toggle(viewer, Section::Lights);
    // With many lights, a search field appears above the list. The search leaves one row.
    const glm::ivec2 searchRow(0, kRowPixels);
    viewer.click(inRow(viewer, Section::Lights, 2, 60));
    viewer.type("column foot 0");
    viewer.pause(0.5);
    viewer.click(lightName(viewer, 0) + searchRow);
    viewer.moveTo(middlePixel());
    viewer.pause(0.5);
    const Shot selected = pictureIn(viewer, size);
    EXPECT_FALSE(selected == turned) << "the lamp has no handles";
    constexpr int kIntensityRow = 3;
    const glm::ivec2 intensity = inLightRow(viewer, kIntensityRow, 150) + searchRow;
    const Shot brighter = after(viewer, [&] {
        viewer.drag(intensity, intensity + glm::ivec2(100, 0));
        viewer.moveTo(middlePixel());
    });
    EXPECT_FALSE(brighter == selected) << "the lamp is in view";
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+z"); }) == selected) << "the drag is one step";
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+shift+z"); }) == brighter);
    viewer.click(lightName(viewer, 0) + searchRow); // deselects it
    viewer.moveTo(middlePixel());
    viewer.pause(0.5);
    const Shot edited = pictureIn(viewer, size);

    const std::string saved = saveScene(viewer);
    const nlohmann::json lights = readJson(saved).at("lights");
    EXPECT_EQ(lights.size(), 258u);
    EXPECT_TRUE(rendered(saved + " --technique clustered_deferred", size) == edited) << saved;

    // The other side starts with a forward technique.
    std::size_t mark = viewer.mark();
    viewer.key("x"); // split
    viewer.key("x"); // difference
    viewer.waitForWhole(mark);
    const auto litShare = [](const Shot& shot) {
        return differingShare(shot, Shot{shot.sizePixels, std::vector<std::uint8_t>(shot.rgb.size(), 0)});
    };
    // The first line names the sides; the second reports that nothing differs, once the figures are computed.
    constexpr int kLineStepPixels = 30, kNamesPixels = 80;
    Shot difference = pictureIn(viewer, size);
    const auto secondLine = [&] { return difference.part({0, kLineStepPixels}, {size.x / 2, kLineStepPixels}); };
    for (int i = 0; i < 120 && litShare(secondLine()) < 0.05; ++i) {
        viewer.pause(0.5);
        difference = pictureIn(viewer, size);
    }
    EXPECT_GT(litShare(secondLine()), 0.05) << "no figures, or none that say that the sides are equal, within a minute";
    EXPECT_EQ(litShare(difference.part({0, kNamesPixels}, {size.x, size.y - kNamesPixels})), 0.0);
    const Picture left = savedRadiance(viewer);
    viewer.key("z"); // switches to the other side
    const Picture right = savedRadiance(viewer);
    const validation::RadianceFigures figures = validation::radianceFigures(left, right);
    EXPECT_EQ(figures.maxRel, 0.0) << "at " << figures.worstX << ", " << figures.worstY;
    viewer.key("z");
    viewer.key("x");
    bool isAlone = false; // not logged: the image may still exist
    for (int i = 0; i < 120 && !isAlone; ++i) {
        viewer.pause(0.5);
        isAlone = pictureIn(viewer, size) == edited;
    }
    EXPECT_TRUE(isAlone) << "the comparison stays";

    viewer.moveTo(middlePixel());
    mark = viewer.mark();
    viewer.key("i");
    const std::string said = viewer.waitFor("inspected ", mark);
    for (const char* word : {"linear ", "; material ", "; depth ", "; face normal ", " reach"})
        EXPECT_NE(said.find(word), std::string::npos) << word << " in " << said;
    viewer.pause(1.0);
    EXPECT_FALSE(pictureIn(viewer, size) == edited) << "there is no loupe";
    viewer.key("i");

    // Undo selects the changed light. Without the edit, the scene differs from the saved one.
    EXPECT_TRUE(after(viewer, [&] { viewer.key("ctrl+z"); }) == selected);
    mark = viewer.mark();
    viewer.key("ctrl+q");
    viewer.waitFor("edits are not saved", mark);
    viewer.pause(0.5);
    EXPECT_GT(differingShare(pictureIn(viewer, size), selected), 0.01) << "there is no dialog";
    viewer.key("d");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
    EXPECT_EQ(viewer.errors(), "");
}

} // namespace
} // namespace tessera::test
