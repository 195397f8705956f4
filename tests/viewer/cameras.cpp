// Orbiting, panning, zooming and flying by mouse and keys.
#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerCameras = ViewerTest;

TEST_F(ViewerCameras, everyGestureMovesThePictureAndHomeBringsItBackExactly) {
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

TEST_F(ViewerCameras, aPictureAtRestIsNotDrawnAgain) {
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    const std::size_t mark = viewer.mark();
    viewer.pause(2.0);
    EXPECT_EQ(viewer.mark(), mark) << "something was done while nothing changed";
}

} // namespace
} // namespace tessera::test
