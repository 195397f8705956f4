// The window's image equals the file that `tessera render` writes.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/support/AssetsFolder.h"
#include "tests/support/Sweep.h"
#include "tests/viewer/ViewerTest.h"
#include "validation/figures/ErrorFigures.h"
#include "validation/pictures/HeatMap.h"

namespace tessera::test {
namespace {

class ViewerPictures : public ViewerTest {
protected:
    /// Compares the hall with 256 lights in a whole sweep, else the spheres, which are drawn in a tenth of the time.
    void expectThePictureOfRender();
    /// With 256 diffusion texels in a whole sweep, else 64.
    void expectDiffusedLightOfACameraThatMoves();
    /// The inspector's text for the pixel under the pointer, once nothing changes. Inspecting starts and ends here.
    static std::string saidOfPixel(const DrivenViewer& viewer) {
        const std::size_t mark = viewer.mark();
        viewer.key("i");
        const std::string said = viewer.waitFor("inspected ", mark);
        viewer.key("i");
        return said;
    }
};
using ViewerPicturesSlow = ViewerPictures;

/// Height of the names and meaning of a view at the top of the image.
constexpr int kTitlePixels = 80;
/// The image below them.
Shot belowTitle(const Shot& shot) {
    return shot.part({0, kTitlePixels}, {shot.sizePixels.x, shot.sizePixels.y - kTitlePixels});
}

void ViewerPictures::expectThePictureOfRender() {
    std::vector<std::string> words{"spheres", "--technique", "clustered_deferred"};
    if (isWholeSweep()) words = {"hall", "--lights", "256", "--technique", "clustered_deferred"};
    DrivenViewer viewer = open(words);
    const glm::ivec2 size = viewer.waitForWhole(0);
    EXPECT_EQ(size.x, screenPixels().x - kPanelPixels);
    const Shot shown = pictureIn(viewer, size);
    const std::string opened = asOpened(words.front(), size);
    EXPECT_TRUE(shown == rendered(fmt::format("{} {}", opened, fmt::join(words.begin() + 1, words.end(), " ")), size));
    // Neither empty nor one colour.
    EXPECT_GT(differingShare(shown, Shot{size, std::vector<std::uint8_t>(shown.rgb.size(), shown.rgb[0])}, 8), 0.5);

    std::size_t mark = viewer.mark();
    viewer.key("t");
    viewer.waitFor("drawn", mark);
    EXPECT_TRUE(pictureIn(viewer, viewer.waitForWhole(mark)) == shown) << "techniques differ";
    EXPECT_NE(viewer.waitFor("drawn", mark).find("technique clustered_forward"), std::string::npos);

    // Views by their keys, and back. The view of G (key 5) shows the brightest light.
    for (const auto& [key, options] : {std::pair("3", ""), std::pair("5", " --solo ")}) {
        SCOPED_TRACE(key);
        mark = viewer.mark();
        viewer.key(key);
        const Shot view = pictureIn(viewer, viewer.waitForWhole(mark));
        EXPECT_GT(differingShare(view, Shot{size, std::vector<std::uint8_t>(view.rgb.size(), 0)}, 8), 0.05) << "dark";
        mark = viewer.mark();
        viewer.key("ctrl+c");
        std::string command = viewer.waitFor("command tessera render ", mark);
        EXPECT_NE(command.find(options), std::string::npos) << command;
        EXPECT_NE(command.find(opened.substr(words.front().size())), std::string::npos) << command;
        command = command.substr(std::string("command ").size());
        shell(command.substr(0, command.rfind(" -o ")) + " -o pasted.png");
        const Shot pasted = readShot(folder_.path() / "pasted.png");
        EXPECT_TRUE(belowTitle(pasted) == belowTitle(view)) << command;
        EXPECT_GT(differingShare(view.part({0, 0}, {size.x / 2, kTitlePixels}),
                                 pasted.part({0, 0}, {size.x / 2, kTitlePixels})),
                  0.1)
            << "nothing in the picture says which view it is";
        viewer.key("Escape"); // dismisses the message
        viewer.pause(0.3);
    }
    mark = viewer.mark();
    viewer.key("7");
    EXPECT_TRUE(pictureIn(viewer, viewer.waitForWhole(mark)) == shown);
    viewer.key("ctrl+q");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}
TEST_F(ViewerPictures, theWindowShowsThePictureOfRenderBitForBit) {
    expectThePictureOfRender();
}
TEST_F(ViewerPicturesSlow, theWindowShowsThePictureOfRenderBitForBit) {
    expectThePictureOfRender();
}

TEST_F(ViewerPictures, theInspectorReportsTheValuesOfThePixelAndShowsItLarge) {
    DrivenViewer viewer = open(kSpheres);
    const glm::ivec2 size = viewer.waitForWhole(0);
    const Shot alone = pictureIn(viewer, size);
    const glm::ivec2 place = sphereIn(size), pixel = place - kPictureCorner;
    viewer.moveTo(place);
    std::size_t mark = viewer.mark();
    viewer.key("i");
    const std::string said = viewer.waitFor("inspected ", mark);
    viewer.pause(1.0);
    const Shot inspected = pictureIn(viewer, size);
    mark = viewer.mark();
    viewer.key("shift+F12");
    const Picture saved = exr(savedFile(viewer.waitFor("saved ", mark)));
    const float* const radiance = saved.pixel(std::size_t(pixel.y * saved.width + pixel.x));
    const glm::ivec3 shown = alone.at(pixel);
    EXPECT_TRUE(said.starts_with(
        fmt::format("inspected {}, {} of {}x{}; linear {:.4g} {:.4g} {:.4g}; shown #{:02x}{:02x}{:02x}", pixel.x,
                    pixel.y, size.x, size.y, radiance[0], radiance[1], radiance[2], shown.x, shown.y, shown.z)))
        << said;
    EXPECT_NE(said.find("; material metalness 0/4, roughness 4/10; depth "), std::string::npos) << said;
    // The loupe's centre is 90 pixels off, each pixel 8 wide, if there is space for it below and to the right.
    constexpr int kBoxPixels = 300;
    const bool isBelow = std::min(size.x - pixel.x, size.y - pixel.y) > kBoxPixels;
    EXPECT_TRUE(isBelow || screenPixels() == glm::ivec2(800, 600));
    for (const glm::ivec2 off : {glm::ivec2(0, 0), glm::ivec2(3, 0), glm::ivec2(-2, 5)}) {
        if (!isBelow) continue;
        EXPECT_EQ(inspected.at(pixel + 90 + 8 * off), alone.at(pixel + off)) << off.x << ", " << off.y;
    }
    viewer.key("Escape"); // dismisses the message
    viewer.key("i");
    viewer.pause(1.0);
    EXPECT_TRUE(pictureIn(viewer, size) == alone);
    after(viewer, [&] { viewer.key("3"); });
    const std::string normals = saidOfPixel(viewer);
    const std::size_t picture = normals.find("; normal "), ray = normals.find("; shading normal ");
    ASSERT_TRUE(picture != std::string::npos && ray != std::string::npos) << normals;
    glm::dvec3 ofPicture(0.0), ofRay(0.0);
    std::sscanf(normals.c_str() + picture, "; normal %lf %lf %lf", &ofPicture.x, &ofPicture.y, &ofPicture.z);
    std::sscanf(normals.c_str() + ray, "; shading normal %lf %lf %lf", &ofRay.x, &ofRay.y, &ofRay.z);
    EXPECT_NEAR(glm::length(ofRay), 1.0, 1e-3) << normals;
    // Four digits are logged, and a rasteriser may snap vertices by 1/256 of a pixel, which turns the normal of this
    // sphere of some 45 pixels by 1e-4. The triangle's face normal is off by up to 0.05.
    EXPECT_LT(glm::distance(ofPicture, ofRay), 1e-3) << normals;
}

TEST_F(ViewerPictures, theInspectorReportsHowManyLightsEachSideVisits) {
    DrivenViewer viewer =
        open({"lattice", "--fov", "45", "--lights", "64", "--technique", "clustered_forward", "--view", "lights"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    std::size_t mark = viewer.mark();
    viewer.key("shift+F12");
    const Picture counts = exr(savedFile(viewer.waitFor("saved ", mark)));
    viewer.key("Escape"); // dismisses the message
    viewer.pause(0.3);
    const auto countAt = [&](glm::ivec2 pixel) {
        return counts.pixel(std::size_t(pixel.y * counts.width + pixel.x))[0];
    };
    // The pixel that visits most lights in the middle of the left half, away from the divider and surface edges.
    glm::ivec2 pixel(0);
    for (int y = size.y / 4; y < size.y * 3 / 4; ++y)
        for (int x = size.x / 8; x < size.x * 3 / 8; ++x) {
            const glm::ivec2 here(x, y);
            const float count = countAt(here);
            bool isAlike = count > countAt(pixel);
            for (const glm::ivec2 off : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
                isAlike = isAlike && countAt(here + off) == count;
            if (isAlike) pixel = here;
        }
    const int most = int(countAt(pixel));
    ASSERT_GT(most, 0);
    viewer.moveTo(kPictureCorner + pixel);
    const auto expectSaid = [](const std::string& said, const std::string& part) {
        EXPECT_NE(said.find(part), std::string::npos) << part << "\nin\n" << said;
    };
    const std::string visited = fmt::format("visits {} light{}", most, most == 1 ? "" : "s");
    std::string said = saidOfPixel(viewer);
    expectSaid(said, fmt::format("; lights {}; shown #", most));
    expectSaid(said, fmt::format("; {}, ", visited));

    viewer.key("x"); // split
    viewer.key("z");
    viewer.pause(0.5);
    mark = viewer.mark();
    viewer.key("t"); // forward at the right, two steps from its default; it visits all lights
    viewer.key("t");
    viewer.waitForWhole(mark);
    said = saidOfPixel(viewer);
    expectSaid(said, fmt::format("; Left; lights {}; shown #", most));
    const std::size_t right = said.find("; Right; lights ");
    ASSERT_NE(right, std::string::npos) << said;
    int all = 0;
    ASSERT_EQ(std::sscanf(said.c_str() + right, "; Right; lights %d", &all), 1) << said;
    EXPECT_GT(all, most);
    expectSaid(said, fmt::format("; {}; Right; ", visited));
    expectSaid(said, fmt::format("; visits {0} lights; difference {1} {1} {1}; material ", all, most - all));

    viewer.key("7"); // lit images
    viewer.key("z");
    viewer.pause(0.5);
    mark = viewer.mark();
    viewer.key("7");
    viewer.waitForWhole(mark);
    said = saidOfPixel(viewer);
    expectSaid(said, "; Left; linear ");
    expectSaid(said, fmt::format("; {}; Right; linear ", visited));
    expectSaid(said, fmt::format("; visits {} lights; difference 0 0 0; material ", all));
    EXPECT_TRUE(said.ends_with(" it")) << said;
    EXPECT_EQ(said.find(" it"), said.size() - 3)
        << "the lights that reach the place are listed more than once: " << said;
}

TEST_F(ViewerPictures, aClickOnTheLargestErrorOfAComparisonInspectsItsPixel) {
    DrivenViewer viewer = open({"spheres"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    makeRoom(viewer);
    std::size_t mark = viewer.mark();
    viewer.key("x"); // split
    viewer.key("x"); // difference
    viewer.key("3"); // another view on the left side
    viewer.waitForWhole(mark);
    const Picture left = savedRadiance(viewer);
    viewer.key("z"); // switches to the other side
    const Picture right = savedRadiance(viewer);
    const validation::RadianceFigures figures = validation::radianceFigures(left, right);
    ASSERT_GT(figures.maxRel, 0.0);

    toggle(viewer, Section::Compare);
    // The line after Compare, Active side, Amplified, Bit-equal, relMse, median rel and p99 rel; greyed until measured.
    constexpr std::size_t kWorst = 7;
    std::vector<int> lines = linesOf(viewer, Section::Compare);
    for (int i = 0; i < 120 && lines.size() <= kWorst; ++i) {
        viewer.pause(0.5);
        lines = linesOf(viewer, Section::Compare);
    }
    ASSERT_GT(lines.size(), kWorst) << "no errors are shown within a minute";
    mark = viewer.mark();
    viewer.click({130, lines[kWorst]});
    const std::string said = viewer.waitFor("inspected ", mark);
    EXPECT_TRUE(
        said.starts_with(fmt::format("inspected {}, {} of {}x{}; ", figures.worstX, figures.worstY, size.x, size.y)))
        << said << " against " << figures.worstX << ", " << figures.worstY;
    const auto valuesOf = [&](const Picture& side) {
        const float* const rgba = side.pixel(std::size_t(figures.worstY * side.width + figures.worstX));
        return fmt::format("{:.4g} {:.4g} {:.4g}", rgba[0], rgba[1], rgba[2]);
    };
    EXPECT_NE(said.find(fmt::format("; Left; normal {}; shown #", valuesOf(left))), std::string::npos) << said;
    EXPECT_NE(said.find(fmt::format("; Right; linear {}; shown #", valuesOf(right))), std::string::npos) << said;
    EXPECT_EQ(said.find("; difference "), std::string::npos) << "of different views: " << said;
}

TEST_F(ViewerPictures, theCommandToPasteRendersTheSavedPictureToTheLastBit) {
    DrivenViewer viewer = open({"models"});
    viewer.waitForWhole(0);
    std::size_t mark = viewer.mark();
    viewer.drag(middlePixel(), middlePixel() + glm::ivec2(120, 40));
    viewer.key("bracketright"); // exposure
    viewer.waitForWhole(mark);
    mark = viewer.mark();
    viewer.key("shift+F12");
    const std::string saved = savedFile(viewer.waitFor("saved ", mark));
    mark = viewer.mark();
    viewer.key("ctrl+c");
    std::string command = viewer.waitFor("command ", mark);
    command = command.substr(command.find(' ') + 1);
    EXPECT_TRUE(command.starts_with("tessera render models ")) << command;
    // Replaces the file that the command names.
    shell(command.substr(0, command.rfind(" -o ")) + " -o pasted.exr");
    const Picture a = exr(saved), b = exr("pasted.exr");
    ASSERT_EQ(a.width, b.width);
    EXPECT_TRUE(a.rgba == b.rgba) << command;
    mark = viewer.mark();
    viewer.key("F12");
    const std::string png = savedFile(viewer.waitFor("saved ", mark));
    const Shot file = readShot(folder_.path() / png);
    viewer.key("Escape"); // dismisses the message
    viewer.pause(1.0);
    EXPECT_TRUE(pictureIn(viewer, file.sizePixels) == file) << "the screenshot is not what the window shows";
}

void ViewerPictures::expectDiffusedLightOfACameraThatMoves() {
    // In the bust's marble light diffuses far enough for coarse texels; for the scan a note would cover the image.
    const tessera::test::AssetsFolder none(nullptr);
    const std::string scene = isWholeSweep() ? "head_skin" : "head_marble", texels = isWholeSweep() ? "256" : "64";
    DrivenViewer viewer = open({scene, "--diffusion-texels", texels});
    const glm::ivec2 size = viewer.waitForWhole(0);
    EXPECT_TRUE(pictureIn(viewer, size) == rendered(asOpened(scene, size) + " --diffusion-texels " + texels, size));
    viewer.waitFor("diffused light in view", 0);
    viewer.waitFor("diffused light everywhere", 0);
    // The image at full resolution does not wait for diffusion.
    const std::vector<std::string> opening = viewer.lines();
    const auto at = [&](const auto& is) { return std::ranges::find_if(opening, is) - opening.begin(); };
    EXPECT_LT(at([](const std::string& line) {
                  return line.starts_with("drawn ") && line.find(" scale 1 ") != line.npos &&
                         line.ends_with(" lacks light");
              }),
              at([](const std::string& line) { return line == "diffused light in view"; }));
    // Viewing another side needs no further diffusion.
    std::size_t mark = viewer.mark();
    viewer.drag(middlePixel(), middlePixel() + glm::ivec2(300, 20));
    const Shot shown = pictureIn(viewer, viewer.waitForWhole(mark));
    const std::vector<std::string> lines = viewer.lines();
    for (std::size_t i = mark; i < lines.size(); ++i) EXPECT_FALSE(lines[i].starts_with("diffused light")) << lines[i];
    mark = viewer.mark();
    viewer.key("ctrl+c");
    std::string command = viewer.waitFor("command ", mark);
    command = command.substr(command.find(' ') + 1);
    shell(command.substr(0, command.rfind(" -o ")) + " -o pasted.png");
    EXPECT_TRUE(readShot(folder_.path() / "pasted.png") == shown) << command;
}
TEST_F(ViewerPictures, aCameraThatMovesUsesTheDiffusedLightThatIsThereAndAtRestAllOfIt) {
    expectDiffusedLightOfACameraThatMoves();
}
TEST_F(ViewerPicturesSlow, aCameraThatMovesUsesTheDiffusedLightThatIsThereAndAtRestAllOfIt) {
    expectDiffusedLightOfACameraThatMoves();
}

TEST_F(ViewerPictures, ctrlAndTheWheelMagnifyPixelsAndKeysPinAndCopyTheirValues) {
    DrivenViewer viewer = open(kSpheres);
    const Shot whole = pictureIn(viewer, viewer.waitForWhole(0));
    const glm::ivec2 size = whole.sizePixels, middle = size / 2;
    viewer.moveTo(kPictureCorner + middle);
    viewer.wheel(3, "ctrl"); // magnifies 8 times
    viewer.pause(1.0);
    const Shot large = pictureIn(viewer, size);
    // The pixel under the pointer stays there, as a square of one colour with its neighbours beside it.
    constexpr int kTimes = 8, kReach = 5;
    int wrong = 0;
    for (int y = -kReach; y <= kReach; ++y)
        for (int x = -kReach; x <= kReach; ++x) {
            const glm::ivec2 place = middle + kTimes * glm::ivec2(x, y) + kTimes / 2;
            wrong += large.at(place) != whole.at(middle + glm::ivec2(x, y));
        }
    EXPECT_EQ(wrong, 0);
    viewer.drag(kPictureCorner + middle, kPictureCorner + middle + glm::ivec2(4 * kTimes, 0));
    viewer.moveTo(kPictureCorner + middle);
    viewer.pause(0.5);
    EXPECT_EQ(pictureIn(viewer, size).at(middle + kTimes / 2), whole.at(middle - glm::ivec2(4, 0))) << "it moved";
    const std::size_t mark = viewer.mark();
    viewer.key("i");
    const std::string reported = viewer.waitFor("inspected ", mark);
    EXPECT_NE(reported.find(fmt::format("inspected {}, {} of ", middle.x - 4, middle.y)), std::string::npos)
        << reported;
    viewer.key("p");
    EXPECT_NE(viewer.waitFor("pinned ", mark).find(fmt::format("{}, {} of ", middle.x - 4, middle.y)),
              std::string::npos);
    viewer.key("i");
    viewer.key("ctrl+0");
    viewer.pause(1.0);
    EXPECT_TRUE(pictureIn(viewer, size) == whole) << "the camera did not move";
    viewer.moveTo(kPictureCorner + middle);
    viewer.wheel(6, "ctrl"); // 64 times, the most
    viewer.pause(1.0);
    EXPECT_EQ(pictureIn(viewer, size).at(middle + 32), whole.at(middle));
}

TEST_F(ViewerPictures, edgesAreSmoothedAtRestAndFilesAreNot) {
    folder_.write("config/tessera/viewer.json", "{}");
    DrivenViewer viewer = open(kSpheres);
    const glm::ivec2 size = viewer.waitForWhole(0);
    viewer.waitFor("smoothed", 0, 300.0);
    viewer.pause(1.0);
    const Shot smooth = pictureIn(viewer, size), plain = rendered("spheres --fov 40", size);
    const double share = differingShare(smooth, plain, 4);
    EXPECT_GT(share, 0.001) << "no edge was smoothed";
    EXPECT_LT(share, 0.2) << "more than edges was changed";
    std::size_t mark = viewer.mark();
    viewer.key("F12");
    EXPECT_TRUE(readShot(folder_.path() / savedFile(viewer.waitFor("saved ", mark))) == plain);
    viewer.key("Escape");
    mark = viewer.mark();
    viewer.key("bracketright"); // a change of exposure restarts smoothing
    viewer.waitForWhole(mark);
    viewer.waitFor("smoothed", mark, 300.0);
}

TEST_F(ViewerPictures, heatColoursEndAtTheLargestCountAsInTheFileOfRender) {
    DrivenViewer viewer = open({"room", "--fov", "62", "--view", "lights", "--technique", "clustered_deferred"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    viewer.pause(1.0); // lights are counted once the image is whole
    // Left of the legend.
    const auto beside = [&](const Shot& shot) {
        return shot.part({0, kTitlePixels}, {size.x / 2, size.y - kTitlePixels});
    };
    const Shot file = rendered("room --view lights --technique clustered_deferred", size);
    validation::HeatMapLayout layout = validation::heatMapLayout(size.x, size.y, 1);
    if (layout.height != file.sizePixels.y) layout = validation::heatMapLayout(size.x, size.y, 2);
    ASSERT_EQ(glm::ivec2(layout.width, layout.height), file.sizePixels);
    ASSERT_EQ(layout.scale, 1);
    const Shot inFile = file.part({layout.pictureX, layout.pictureY}, size);
    // The program and the graphics driver may round a colour differently.
    EXPECT_EQ(differingShare(beside(pictureIn(viewer, size)), beside(inFile), 1), 0.0);
}

TEST_F(ViewerPictures, aComparisonDrawsNoSideWhosePictureIsThere) {
    DrivenViewer viewer = open({"lattice", "--fov", "45", "--technique", "forward"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const glm::ivec2 left(size.x / 2 - 20, size.y - kTitlePixels);
    const Shot alone = pictureIn(viewer, size).part({0, kTitlePixels}, left);
    std::size_t mark = viewer.mark();
    viewer.key("x"); // split
    viewer.waitForWhole(mark);
    EXPECT_TRUE(pictureIn(viewer, size).part({0, kTitlePixels}, left) == alone);
    const auto drawnSince = [&viewer](std::size_t from) {
        std::vector<std::string> drawn;
        const std::vector<std::string> lines = viewer.lines();
        for (std::size_t i = from; i < lines.size(); ++i)
            if (lines[i].starts_with("drawn ")) drawn.push_back(lines[i]);
        return drawn;
    };
    for (const std::string& line : drawnSince(mark))
        EXPECT_NE(line.find(" technique clustered_deferred "), line.npos) << line;
    mark = viewer.mark();
    viewer.key("F12");
    const Shot both = readShot(folder_.path() / savedFile(viewer.waitFor("saved ", mark)));
    ASSERT_EQ(both.sizePixels, glm::ivec2(2 * size.x, size.y));
    EXPECT_TRUE(both.part({0, 0}, size) == rendered("lattice --fov 45 --technique forward", size));
    EXPECT_TRUE(both.part({size.x, 0}, size) == both.part({0, 0}, size)) << "techniques are equal to the last bit";
    viewer.key("Escape");
    mark = viewer.mark();
    for (int i = 0; i < 3; ++i) { // difference, single image, split
        viewer.key("x");
        viewer.pause(0.7);
    }
    EXPECT_EQ(drawnSince(mark), std::vector<std::string>());
}

TEST_F(ViewerPictures, differentTechniquesSideBySideDifferInNothing) {
    // With the field of view that its camera is made for, the scene fills much of the image.
    DrivenViewer viewer = open({"lattice", "--fov", "45", "--technique", "forward"});
    const glm::ivec2 size = viewer.waitForWhole(0);
    const Shot alone = pictureIn(viewer, size);
    std::size_t mark = viewer.mark();
    viewer.key("x"); // split
    viewer.key("z");
    viewer.key("t"); // changes the other side
    viewer.waitForWhole(mark);
    const Shot split = pictureIn(viewer, size);
    // The divider, its handle and the names of the sides cover little.
    EXPECT_LT(differingShare(split, alone), 0.03);
    EXPECT_GT(differingShare(split, alone), 0.0005) << "there is no divider";
    viewer.key("x"); // difference of the two existing images
    viewer.pause(2.0);
    const Shot difference = pictureIn(viewer, size);
    const auto litShare = [](const Shot& shot) {
        return differingShare(shot, Shot{shot.sizePixels, std::vector<std::uint8_t>(shot.rgb.size(), 0)});
    };
    EXPECT_EQ(litShare(belowTitle(difference)), 0.0) << "techniques are equal to the last bit, so nothing may be lit";
    constexpr int kTextLinePixels = 30;
    EXPECT_GT(litShare(difference.part({0, 0}, {size.x / 2, kTextLinePixels})), 0.05) << "no message says what differs";
    EXPECT_GT(litShare(difference.part({0, kTextLinePixels}, {size.x / 2, kTextLinePixels})), 0.05)
        << "no message says why it is black";
    mark = viewer.mark();
    viewer.key("3"); // another view on one side
    viewer.waitForWhole(mark);
    EXPECT_GT(differingShare(pictureIn(viewer, size), difference, 4), 0.3) << "nothing is ever lit";
}

} // namespace
} // namespace tessera::test
