// Orbiting, panning, zooming and flying by mouse and keys.
#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

using ViewerCameras = ViewerTest;

TEST_F(ViewerCameras, everyGestureMovesThePictureAndHomeBringsItBackExactly) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 there = middlePixel() + glm::ivec2(150, 60);
    const auto expectMoved = [&](const char* what, const Shot& shot) {
        SCOPED_TRACE(what);
        EXPECT_GT(differingShare(shot, home, 4), 0.2);
        EXPECT_TRUE(after(viewer, [&] { viewer.key("Home"); }) == home);
    };
    expectMoved("rotate", after(viewer, [&] { viewer.drag(middlePixel(), there); }));
    expectMoved("rotate with Shift", after(viewer, [&] { viewer.drag(middlePixel(), there, "shift"); }));
    expectMoved("pan", after(viewer, [&] { viewer.drag(middlePixel(), there, "alt"); }));
    expectMoved("zoom", after(viewer, [&] { viewer.drag(middlePixel(), there, "ctrl"); }));
    expectMoved("wheel", after(viewer, [&] {
                    viewer.moveTo(middlePixel());
                    viewer.wheel(4);
                }));
    expectMoved("fly", after(viewer, [&] {
                    viewer.key("c");
                    viewer.hold("w", 0.5);
                }));
    expectMoved("look around", after(viewer, [&] { viewer.drag(middlePixel(), there); }));
    expectMoved("frame", after(viewer, [&] {
                    viewer.key("c");
                    viewer.key("f");
                }));
}

TEST_F(ViewerCameras, aDoubleClickTurnsAboutTheSurfaceAndFBringsWhatIsSelectedIntoView) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    for (const Section above : {Section::View, Section::Scene}) toggle(viewer, above); // the material's stays in view
    const glm::ivec2 sphere = sphereIn(home.sizePixels);
    std::size_t mark = viewer.mark();
    const Shot turned = after(viewer, [&] { viewer.doubleClick(sphere); });
    viewer.waitFor("turns about a surface", mark);
    EXPECT_GT(differingShare(turned, home, 4), 0.1);
    mark = viewer.mark();
    viewer.click(kPictureCorner + home.sizePixels / 2);
    EXPECT_EQ(viewer.waitFor("picked ", mark), "picked metalness 0/4, roughness 4/10") << "it is not in the middle";
    const Shot near = after(viewer, [&] { viewer.key("f"); });
    EXPECT_GT(differingShare(near, turned, 4), 0.2);
    // The sphere is as large as that now.
    for (const int y : {home.sizePixels.y * 3 / 10, home.sizePixels.y * 7 / 10}) {
        mark = viewer.mark();
        viewer.pause(0.5); // no double click
        viewer.click(kPictureCorner + glm::ivec2(home.sizePixels.x / 2, y));
        EXPECT_EQ(viewer.waitFor("picked ", mark), "picked metalness 0/4, roughness 4/10") << y;
    }
    after(viewer, [&] { viewer.key("Home"); });
    toggle(viewer, Section::Materials); // takes the outline of the sphere away
    EXPECT_TRUE(pictureIn(viewer, home.sizePixels) == home);
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
