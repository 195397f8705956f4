// Undo, redo and revert of edits, and of camera jumps, by keys.
#include <vector>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerUndo : public ViewerTest {
protected:
    static Shot undone(const DrivenViewer& viewer) {
        return after(viewer, [&] { viewer.key("ctrl+z"); });
    }
    static Shot redone(const DrivenViewer& viewer) {
        return after(viewer, [&] { viewer.key("ctrl+shift+z"); });
    }
    /// Quits without a question, since nothing is edited.
    static void expectQuits(DrivenViewer& viewer) {
        viewer.key("ctrl+q");
        EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
        for (const std::string& line : viewer.lines()) EXPECT_NE(line, "edits are not saved");
    }
};

TEST_F(ViewerUndo, anEditOfAMaterialIsUndoneRedoneAndReverted) {
    DrivenViewer viewer = open(kSpheres);
    const Shot before = pictureIn(viewer, viewer.waitForWhole(0));
    pickSphere(viewer, before.sizePixels);
    constexpr int kMetallic = 4; // row of the slider
    const glm::ivec2 slider = inRow(viewer, Section::Materials, kMetallic, 200);
    const std::size_t mark = viewer.mark();
    viewer.drag(slider, {kPanelPixels - 2, slider.y});
    viewer.waitForWhole(mark);
    toggle(viewer, Section::Materials); // removes the outline
    const Shot metal = pictureIn(viewer, before.sizePixels);
    EXPECT_GT(differingShare(metal, before, 4), 0.005) << "nothing became metal";
    EXPECT_TRUE(undone(viewer) == before) << "the drag is one step";
    EXPECT_TRUE(redone(viewer) == metal);
    toggle(viewer, Section::Save);
    const glm::ivec2 revert = inRow(viewer, Section::Save, 3, 200);
    EXPECT_TRUE(after(viewer, [&] {
                    viewer.click(revert);
                    viewer.moveTo(middlePixel());
                }) == before);
    EXPECT_TRUE(redone(viewer) == metal) << "what was reverted can be redone";
    undone(viewer);
    expectQuits(viewer);
}

TEST_F(ViewerUndo, lightsThatAScatteringReplacedComeBack) {
    DrivenViewer viewer = open(kSpheres);
    const Shot lit = pictureIn(viewer, viewer.waitForWhole(0));
    toggle(viewer, Section::Lights);
    // The button is between the last two labels, in a row without one.
    const std::vector<int> lines = linesOf(viewer, Section::Lights);
    ASSERT_GE(lines.size(), 2u);
    const glm::ivec2 replace(200, (lines.end()[-2] + lines.back()) / 2);
    const Shot scattered = after(viewer, [&] {
        viewer.click(replace);
        viewer.moveTo(middlePixel());
    });
    EXPECT_GT(differingShare(scattered, lit, 4), 0.2);
    EXPECT_TRUE(undone(viewer) == lit);
    EXPECT_TRUE(redone(viewer) == scattered);
    EXPECT_GT(readJson(saveScene(viewer)).at("lights").size(), 100u);
    EXPECT_TRUE(undone(viewer) == lit);
    const std::string saved = saveScene(viewer);
    EXPECT_TRUE(rendered(saved, lit.sizePixels) == lit) << saved;
    expectQuits(viewer);
}

TEST_F(ViewerUndo, aJumpOfTheCameraIsUndoneAndIsNoEdit) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    const Shot turned = after(viewer, [&] { viewer.drag(middlePixel(), middlePixel() + glm::ivec2(150, 60)); });
    EXPECT_GT(differingShare(turned, home, 4), 0.2);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("Home"); }) == home);
    EXPECT_TRUE(undone(viewer) == turned);
    EXPECT_TRUE(redone(viewer) == home);
    EXPECT_TRUE(undone(viewer) == turned);
    expectQuits(viewer);
}

} // namespace
} // namespace tessera::test
