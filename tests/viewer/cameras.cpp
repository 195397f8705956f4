// Orbiting, panning, zooming and flying by mouse and keys.
#include <cstdio>
#include <stdexcept>

#include <glm/geometric.hpp>

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
    const auto pan = [&](const std::string& held, int button) {
        return after(viewer, [&] { viewer.drag(middlePixel(), there, held, button); });
    };
    const Shot panned = pan("alt", 1);
    expectMoved("pan", panned);
    for (const int button : {2, 3}) { // the middle and the right button
        const Shot shot = pan("", button);
        EXPECT_LT(differingShare(shot, panned, 4), 0.001) << "not but for the rounding of the steps' sum";
        expectMoved("pan by a button", shot);
        pan("", button);
        const Shot back = after(viewer, [&] { viewer.drag(there, middlePixel(), "", button); });
        EXPECT_LT(differingShare(back, home, 4), 0.001) << "the same way back";
        viewer.key("Home"); // draws nothing if the sum of the steps is exactly 0
    }
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

TEST_F(ViewerCameras, keysLookAlongTheAxesAndHomeBringsThePictureBack) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    const Shot side = after(viewer, [&] { viewer.key("ctrl+2"); });
    const Shot top = after(viewer, [&] { viewer.key("ctrl+3"); });
    EXPECT_GT(differingShare(side, home, 4), 0.1);
    EXPECT_GT(differingShare(top, side, 4), 0.1);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("KP_3"); }) == side);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("Home"); }) == home);
}

TEST_F(ViewerCameras, theWheelGoesNearerToWhatIsUnderThePointerWhichStaysThere) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    viewer.moveTo(sphereIn(home.sizePixels));
    struct Seen {
        std::string material;
        double depthMetres = 0.0;
        glm::dvec3 faceNormalWS{0.0};
    };
    const auto seen = [&] {
        const std::size_t mark = viewer.mark();
        viewer.key("i");
        const std::string said = viewer.waitFor("inspected ", mark);
        viewer.key("i");
        const std::size_t material = said.find("; material "), depth = said.find("; depth ");
        Seen read;
        if (material == std::string::npos || depth == std::string::npos) throw std::runtime_error(said);
        read.material = said.substr(material, depth - material);
        EXPECT_EQ(std::sscanf(said.c_str() + depth,
                              "; depth %lf m; shading normal %*f %*f %*f; face normal %lf %lf %lf", &read.depthMetres,
                              &read.faceNormalWS.x, &read.faceNormalWS.y, &read.faceNormalWS.z),
                  4)
            << said;
        return read;
    };
    const Seen before = seen();
    EXPECT_EQ(before.material, "; material metalness 0/4, roughness 4/10");
    // Eight steps magnify almost three times. If the image's centre stayed fixed instead, the pointer would be over a
    // surface that was 64 pixels away, outside the sphere of radius 45 (at 1280 x 800).
    after(viewer, [&] { viewer.wheel(8); });
    const Seen near = seen();
    EXPECT_EQ(near.material, before.material);
    EXPECT_LT(near.depthMetres, 0.6 * before.depthMetres);
    // Half a pixel off is at most the next triangle of the sphere, which is tessellated in steps of 5.6 degrees.
    EXPECT_LT(glm::distance(near.faceNormalWS, before.faceNormalWS), 0.2);
    EXPECT_TRUE(after(viewer, [&] { viewer.key("Home"); }) == home);
}

TEST_F(ViewerCameras, aDoubleClickTurnsAboutTheSurfaceAndFBringsWhatIsSelectedIntoView) {
    DrivenViewer viewer = open(kSpheres);
    const Shot home = pictureIn(viewer, viewer.waitForWhole(0));
    makeRoom(viewer); // keeps the material's section in view
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
    // The sphere is now large enough to cover these points.
    for (const int y : {home.sizePixels.y * 3 / 10, home.sizePixels.y * 7 / 10}) {
        mark = viewer.mark();
        viewer.pause(0.5); // not a double click
        viewer.click(kPictureCorner + glm::ivec2(home.sizePixels.x / 2, y));
        EXPECT_EQ(viewer.waitFor("picked ", mark), "picked metalness 0/4, roughness 4/10") << y;
    }
    after(viewer, [&] { viewer.key("Home"); });
    toggle(viewer, Section::Materials); // removes the sphere's outline
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
