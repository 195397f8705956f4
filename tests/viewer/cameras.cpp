// Orbiting, panning, zooming and flying by mouse and keys.
#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerCameras : public ViewerTest {
protected:
    /// What the window shows when all has come to rest after an action.
    template <class Action>
    Shot after(const DrivenViewer& viewer, Action act) {
        const std::size_t mark = viewer.mark();
        act();
        return pictureIn(viewer, viewer.waitForWhole(mark));
    }
};

TEST_F(ViewerCameras, everyGestureAlwaysMovesThePictureAndHomeBringsItBackExactly) {
    DrivenViewer viewer = open({"spheres"});
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 there = kMiddle + glm::ivec2(150, 60);
    const auto expectMoved = [&](const char* what, const Shot& shot) {
        SCOPED_TRACE(what);
        EXPECT_GT(differingShare(shot, home, 4), 0.2);
        EXPECT_TRUE(after(viewer, [&] { viewer.key("Home"); }) == home);
    };
    expectMoved("rotate", after(viewer, [&] { viewer.drag(kMiddle, there); }));
    expectMoved("rotate with Shift", after(viewer, [&] { viewer.drag(kMiddle, there, "shift"); }));
    expectMoved("pan", after(viewer, [&] { viewer.drag(kMiddle, there, "alt"); }));
    expectMoved("zoom", after(viewer, [&] { viewer.drag(kMiddle, there, "ctrl"); }));
    expectMoved("wheel", after(viewer, [&] {
                    viewer.moveTo(kMiddle);
                    viewer.wheel(4);
                }));
    expectMoved("fly", after(viewer, [&] {
                    viewer.key("c");
                    viewer.hold("w", 0.5);
                }));
    expectMoved("look around", after(viewer, [&] { viewer.drag(kMiddle, there); }));
    expectMoved("frame", after(viewer, [&] {
                    viewer.key("c");
                    viewer.key("f");
                }));
}

TEST_F(ViewerCameras, aPanAlwaysBringsThePixelUnderThePointerAlong) {
    DrivenViewer viewer = open({"spheres", "--view", "normal"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const Shot before = pictureIn(viewer, size);
    const glm::ivec2 shift(64, 0);
    const Shot moved = after(viewer, [&] { viewer.drag(kMiddle, kMiddle + shift, "alt"); });
    // Around the middle the picture has moved by the drag; what is nearer or farther than the pivot moves differently.
    const glm::ivec2 part(60, 60);
    const glm::ivec2 at = kMiddle - kPictureCorner - part / 2;
    EXPECT_LT(differingShare(moved.part(at + shift, part), before.part(at, part), 12), 0.25);
    EXPECT_GT(differingShare(moved.part(at, part), before.part(at, part), 12), 0.25);
}

TEST_F(ViewerCameras, aPictureAtRestIsNeverDrawnAgain) {
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    const std::size_t mark = viewer.mark();
    desktop_->xdotool({"sleep", "2"});
    EXPECT_EQ(viewer.mark(), mark) << "something was done while nothing changed";
}

} // namespace
} // namespace tessera::test
