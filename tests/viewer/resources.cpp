// The window that shows the contents of the render graph's resources.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerResources : public ViewerTest {};

TEST_F(ViewerResources, aClickOnAResourceOfTheGraphShowsWhatItHolds) {
    std::vector<std::string> words = kSpheres;
    words.insert(words.end(), {"--technique", "deferred"});
    DrivenViewer viewer = open(words);
    const glm::ivec2 size = viewer.waitForWhole(0);
    const Shot before = pictureIn(viewer, size);
    makeRoom(viewer);
    toggle(viewer, Section::Graph);
    constexpr int kTextX = 60;
    const auto clickLine = [&](std::size_t number) {
        viewer.click({kTextX, linesOf(viewer, Section::Graph).at(number)});
        viewer.moveTo(middlePixel());
        viewer.pause(0.5);
    };
    std::size_t mark = viewer.mark();
    clickLine(1); // below the heading "Resources"
    const std::string captured = viewer.waitFor("captured ", mark);
    EXPECT_NE(captured.find(fmt::format("{} x {}", size.x, size.y)), std::string::npos) << captured;
    const Shot shown = pictureIn(viewer, size);
    EXPECT_GT(differingShare(shown, before, 8), 0.2) << "a window lies over the picture";
    // Without the panels the image has another size, and so has the texture.
    mark = viewer.mark();
    viewer.key("Tab");
    EXPECT_NE(viewer.waitFor("captured ", mark), captured);
    mark = viewer.mark();
    viewer.key("Tab");
    EXPECT_EQ(viewer.waitFor("captured ", mark), captured);
    viewer.key("Escape");
    viewer.pause(0.5);
    EXPECT_TRUE(pictureIn(viewer, size) == before) << "Esc closes it";
}

TEST_F(ViewerResources, aClickOnAThumbnailShowsTheTexture) {
    DrivenViewer viewer = open({"head"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    makeRoom(viewer);
    std::size_t mark = viewer.mark();
    viewer.click(middlePixel());
    viewer.waitFor("outlined ", mark);
    viewer.moveTo(middlePixel());
    const Shot before = pictureIn(viewer, size);
    constexpr int kThumbnailX = 120;
    mark = viewer.mark();
    viewer.click({kThumbnailX, linesOf(viewer, Section::Materials).back()});
    EXPECT_EQ(viewer.waitFor("captured ", mark), "captured bust normals: RGBA16 1024 x 1024");
    viewer.moveTo(middlePixel());
    viewer.pause(0.5);
    EXPECT_GT(differingShare(pictureIn(viewer, size), before, 8), 0.2) << "a window lies over the picture";
}

} // namespace
} // namespace tessera::test
