// Progress of a slow image, its steps, and cancelling it.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerProgressSlow : public ViewerTest {
protected:
    /// Every light at every pixel: a whole image takes seconds on two cores.
    static inline const std::vector<std::string> kSlowScene{"hall", "--technique", "forward"};

    /// Whether the progress box is at the lower left of the image: nothing else has as many pixels of its grey.
    static bool hasBox(const DrivenViewer& viewer) {
        constexpr glm::ivec3 kBox(20, 21, 24);
        constexpr int kLeastPixels = 10000; // of some 19000 including text and a bar, in a window of any size
        const Shot shot = viewer.capture();
        const glm::ivec2 picture = shot.sizePixels - kPictureCorner;
        const Shot part =
            shot.part(kPictureCorner + glm::ivec2(0, picture.y * 3 / 5), {picture.x / 2, picture.y * 2 / 5});
        int boxed = 0;
        for (int y = 0; y < part.sizePixels.y; ++y)
            for (int x = 0; x < part.sizePixels.x; ++x) boxed += part.at({x, y}) == kBox ? 1 : 0;
        return boxed > kLeastPixels;
    }
    /// Scales of the images drawn between two marks.
    static std::vector<double> scales(const DrivenViewer& viewer, std::size_t from, std::size_t to) {
        std::vector<double> drawn;
        const std::vector<std::string> lines = viewer.lines();
        for (std::size_t i = from; i < std::min(to, lines.size()); ++i) {
            int number = 0;
            double scale = 0.0;
            if (std::sscanf(lines[i].c_str(), "drawn %d scale %lf", &number, &scale) == 2) drawn.push_back(scale);
        }
        return drawn;
    }
    /// Presses Esc while an image is drawn, and waits until drawing is cancelled.
    static void cancel(const DrivenViewer& viewer) {
        const std::size_t mark = viewer.mark();
        const auto began = std::chrono::steady_clock::now();
        viewer.key("Escape");
        viewer.waitFor("cancelled scale ", mark);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began;
        // A band takes some 100 ms, a view of a window of 1280 x 800 as much, and xdotool has to start.
        const double viewMs = 100.0 * screenPixels().x * screenPixels().y / (1280.0 * 800.0);
        EXPECT_LE(took.count(), 500.0 + viewMs);
        viewer.pause(0.5);
    }
};

TEST_F(ViewerProgressSlow, aLongPictureReportsHowFarItIsGetsFinerByStepsAndEscLeavesIt) {
    DrivenViewer viewer = open(kSlowScene);
    const std::string reported = viewer.waitFor("progress Drawing the whole picture ", 0, 120.0);
    EXPECT_TRUE(reported.ends_with(" %")) << reported << ": the steps before give the times of passes";
    viewer.pause(0.3);
    EXPECT_TRUE(hasBox(viewer));
    const std::vector<double> steps = scales(viewer, 0, viewer.mark());
    EXPECT_GE(steps.size(), 2u);
    EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end())) << fmt::format("{}", fmt::join(steps, " "));
    ASSERT_FALSE(steps.empty());
    EXPECT_GT(steps.back(), 0.25) << "there is no step between the first picture and the whole one";
    EXPECT_LT(steps.back(), 1.0);

    std::size_t mark = viewer.mark();
    cancel(viewer);
    EXPECT_FALSE(hasBox(viewer));
    const Shot left = viewer.capture();
    viewer.pause(2.0);
    EXPECT_TRUE(scales(viewer, mark, viewer.mark()).empty()) << "it was drawn on";
    EXPECT_TRUE(viewer.capture() == left) << "something moves in a window that rests";

    // Enter draws the cancelled image, like any other; its progress grows until it is finished.
    mark = viewer.mark();
    viewer.key("Return");
    const glm::ivec2 size = viewer.waitForWhole(mark);
    EXPECT_FALSE(hasBox(viewer)) << "the box outlives the picture";
    int latest = -1;
    for (const std::string& line : viewer.lines()) {
        if (line.starts_with("cancelled ")) latest = -1;
        int percent = 0;
        if (std::sscanf(line.c_str(), "progress Drawing the whole picture %d", &percent) != 1) continue;
        EXPECT_GE(percent, latest) << line;
        latest = percent;
    }
    EXPECT_GT(latest, 50) << "the picture is there long before its share is";
    EXPECT_TRUE(pictureIn(viewer, size) == rendered(asOpened("hall", size) + " --technique forward", size));
}

TEST_F(ViewerProgressSlow, aDifferenceReportsWhichSideIsDrawnAndIsCancelledToo) {
    DrivenViewer viewer = open(kSlowScene); // the right side starts with a fast technique
    viewer.waitFor("drawn ", 0);
    const std::size_t begin = viewer.mark();
    viewer.key("x"); // split
    viewer.key("x"); // difference
    const std::string reported = viewer.waitFor("progress Drawing the whole picture, ", begin, 120.0);
    EXPECT_NE(reported.find(", left side "), std::string::npos) << reported;
    viewer.pause(0.3);
    EXPECT_TRUE(hasBox(viewer));
    cancel(viewer);
    EXPECT_FALSE(hasBox(viewer));
    const std::size_t mark = viewer.mark();
    viewer.key("Return");
    viewer.waitForWhole(mark);
    viewer.pause(1.0);
    EXPECT_FALSE(hasBox(viewer));
}

TEST_F(ViewerProgressSlow, aLoadThatFiltersAnEnvironmentSaysSoUntilThePictureIsThere) {
    // The folder holds no filtered environments.
    const std::string cache = (folder_.path() / "cache").string();
    DrivenViewer viewer = open({"spheres", "--environment", "sky"}, {{"XDG_CACHE_HOME", cache}});
    bool wasThere = false;
    for (int i = 0; i < 50 && !wasThere; ++i) wasThere = hasBox(viewer);
    EXPECT_TRUE(wasThere);
    viewer.waitForWhole(0);
    EXPECT_FALSE(hasBox(viewer));
}

TEST_F(ViewerProgressSlow, escGivesUpAnEnvironmentThatIsLoadedBeforeThePictureThatIsDrawnMeanwhile) {
    constexpr std::size_t kTexels = 2048 * 1024; // take seconds to filter
    folder_.write("grey.hdr",
                  "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1024 +X 2048\n" + std::string(4 * kTexels, '\x80'));
    DrivenViewer viewer = open(kSlowScene, {{"XDG_CACHE_HOME", (folder_.path() / "cache").string()}});
    viewer.waitFor("progress Drawing the whole picture ", 0, 120.0);
    std::size_t mark = viewer.mark();
    viewer.key("ctrl+o");
    viewer.waitFor("shows the open dialog", mark);
    viewer.pause(0.7);
    viewer.type("grey.hdr");
    viewer.pause(0.3);
    mark = viewer.mark();
    viewer.key("Return");
    viewer.waitFor("loading environment ", mark);
    viewer.pause(0.3);
    viewer.key("Escape");
    viewer.waitFor("cancelled environment ", mark);
    viewer.waitForWhole(mark);
    const std::vector<std::string> lines = viewer.lines();
    for (std::size_t i = mark; i < lines.size(); ++i)
        EXPECT_FALSE(lines[i].starts_with("cancelled scale") || lines[i].starts_with("environment ")) << lines[i];
}

} // namespace
} // namespace tessera::test
