// The pointer's shape, which indicates what a press does.
#include <functional>

#include "tests/viewer/Cursor.h"
#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerPointer : public ViewerTest {
protected:
    /// Waits up to 10 s for the expected pointer; returns the latest one.
    static Cursor cursorOnce(const DrivenViewer& viewer, const std::function<bool(const Cursor&)>& isExpected) {
        Cursor cursor = cursorOf(desktop_->display());
        for (int i = 0; i < 100 && !isExpected(cursor); ++i) {
            viewer.pause(0.1);
            cursor = cursorOf(desktop_->display());
        }
        return cursor;
    }
};

TEST_F(ViewerPointer, hasShapesOfItsOwnOnHandlesAndOnTheDivider) {
    DrivenViewer viewer = openPanel();
    const glm::ivec2 size = viewer.waitForWhole(0);
    const glm::ivec2 middle = kPictureCorner + size / 2;
    const glm::ivec2 beside = kPictureCorner + glm::ivec2(size.x / 8, size.y / 4); // nothing can be dragged there
    viewer.key("m");
    viewer.click(middle); // on the marker: selects the light
    const auto isWide = [](const Cursor& cursor) { return cursor.extentPixels().x > cursor.extentPixels().y; };
    const auto isTall = [](const Cursor& cursor) { return cursor.extentPixels().x < cursor.extentPixels().y; };

    const glm::ivec2 side = middle + glm::ivec2(size.y / 5, 0);
    viewer.moveTo(side);
    const Cursor leftRight = cursorOnce(viewer, isWide);
    EXPECT_TRUE(isWide(leftRight)) << "its width is dragged to the sides";
    viewer.moveTo(beside);
    const Cursor plain = cursorOnce(viewer, [&](const Cursor& cursor) { return cursor != leftRight; });
    EXPECT_FALSE(plain == leftRight);
    EXPECT_GT(plain.extentPixels().x, 0) << "there is no pointer";

    constexpr int kTipPixels = 100, kDirectionPixels = 70; // offsets of the arm along y, and of the direction's handle
    const auto isAnother = [&](const Cursor& cursor) { return cursor != plain && cursor != leftRight; };
    viewer.moveTo(middle - glm::ivec2(0, kTipPixels));
    const Cursor upDown = cursorOnce(viewer, isAnother);
    EXPECT_TRUE(isAnother(upDown) && isTall(upDown)) << "an arm along y is dragged up and down";
    viewer.moveTo(beside);
    EXPECT_TRUE(cursorOnce(viewer, [&](const Cursor& cursor) { return cursor == plain; }) == plain);
    viewer.moveTo(middle + glm::ivec2(0, kDirectionPixels));
    const auto isHand = [&](const Cursor& cursor) { return isAnother(cursor) && cursor != upDown; };
    EXPECT_TRUE(isHand(cursorOnce(viewer, isHand))) << "a direction is dragged anywhere";

    // The divider is in the centre of the image, from top to bottom.
    const glm::ivec2 divider(middle.x, size.y / 8);
    viewer.moveTo(divider);
    EXPECT_TRUE(cursorOnce(viewer, [&](const Cursor& cursor) { return cursor == plain; }) == plain);
    viewer.key("x");
    EXPECT_TRUE(cursorOnce(viewer, [&](const Cursor& cursor) { return cursor == leftRight; }) == leftRight);
    viewer.moveTo(divider + glm::ivec2(40, 0));
    EXPECT_TRUE(cursorOnce(viewer, [&](const Cursor& cursor) { return cursor == plain; }) == plain);
}

} // namespace
} // namespace tessera::test
