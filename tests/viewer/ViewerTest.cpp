#include "tests/viewer/ViewerTest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "base/PictureFile.h"
#include "scenes/Load.h"
#include "tests/support/UnderLedger.h"
#include "validation/pictures/ReadPicture.h"

namespace tessera::test {
namespace {

// The list of scenes below its box: the built-in ones, a line, the recent files.
constexpr int kEntryPixels = 18;
constexpr int kFirstEntryPixels = 24;
constexpr int kLinePixels = 6;
constexpr std::string_view kBuiltin[] = {"hall",         "spheres", "models",    "lattice",     "room",
                                         "shadow_truth", "head",    "head_skin", "head_marble", "diffusion_truth",
                                         "lamps",        "studio",  "glass"};

/// Clicks the entry this far below the list's box.
void chooseEntry(const DrivenViewer& viewer, glm::ivec2 box, int pixels) {
    viewer.click(box);
    viewer.click(box + glm::ivec2(0, pixels));
}

} // namespace

glm::ivec2 ViewerTest::screenPixels() {
    const char* const requested = std::getenv("TESSERA_TEST_SCREEN");
    glm::ivec2 size(1280, 800);
    if (requested != nullptr && std::sscanf(requested, "%dx%d", &size.x, &size.y) != 2)
        throw std::runtime_error(fmt::format("TESSERA_TEST_SCREEN is '{}'; give WIDTHxHEIGHT", requested));
    return size;
}

int ViewerTest::barOf(const DrivenViewer& viewer, Section section) {
    // Bars extend further to the left than anything else in the panels.
    constexpr int kColumn = 6, kLeastHeight = 12;
    const auto barsInView = [&] {
        const Shot shot = viewer.capture();
        const glm::ivec3 behind = shot.at({kColumn, 1});
        std::vector<int> bars;
        int begin = -1;
        for (int y = 0; y < shot.sizePixels.y; ++y) {
            const bool isBar = shot.at({kColumn, y}) != behind;
            if (isBar && begin < 0) begin = y;
            if (isBar || begin < 0) continue;
            if (y - begin >= kLeastHeight) bars.push_back((begin + y) / 2);
            begin = -1;
        }
        return bars;
    };
    std::vector<int> bars = barsInView();
    if (bars.size() <= std::size_t(section)) { // on a small screen the panels scroll to the selected item
        scrollToTop(viewer);
        bars = barsInView();
    }
    if (bars.size() <= std::size_t(section)) throw std::runtime_error("a section of the panels is not in view");
    return bars[std::size_t(section)];
}

std::vector<int> ViewerTest::linesOf(const DrivenViewer& viewer, Section section) {
    // Only bars extend to the bar column, and widgets beside labels begin to the right of the end column. Lines and
    // frames contrast less with the panels than any letter, and greyed letters less than half as much as others.
    constexpr int kBarColumn = 6, kFirstColumn = 10, kEndColumn = 105, kLetterSteps = 85, kBrightSteps = 110;
    const int bar = barOf(viewer, section);
    const Shot shot = viewer.capture();
    const glm::ivec3 behind = shot.at({kBarColumn, 1});
    const auto isBar = [&](int y) { return shot.at({kBarColumn, y}) != behind; };
    const auto brightness = [&](int y) {
        int most = 0;
        for (int x = kFirstColumn; x < kEndColumn; ++x) most = std::max(most, shot.at({x, y}).y - behind.y);
        return most;
    };
    int y = bar;
    while (y < shot.sizePixels.y && isBar(y)) ++y;
    std::vector<int> lines;
    int begin = -1, brightest = 0;
    constexpr int kRulePixels = 3; // largest thickness of lines between rows
    for (; y < shot.sizePixels.y - kRulePixels && !(isBar(y) && isBar(y + kRulePixels)); ++y) {
        const int bright = brightness(y);
        if (bright > kLetterSteps) {
            if (begin < 0) begin = y;
            brightest = std::max(brightest, bright);
        } else if (begin >= 0) {
            if (brightest > kBrightSteps) lines.push_back((begin + y) / 2);
            begin = -1;
            brightest = 0;
        }
    }
    return lines;
}

void ViewerTest::makeRoom(const DrivenViewer& viewer) {
    for (const Section open : {Section::View, Section::Scene}) toggle(viewer, open);
}

void ViewerTest::pickSphere(const DrivenViewer& viewer, glm::ivec2 sizePixels) {
    makeRoom(viewer);
    const std::size_t mark = viewer.mark();
    viewer.click(sphereIn(sizePixels));
    EXPECT_EQ(viewer.waitFor("picked ", mark), "picked metalness 0/4, roughness 4/10");
    viewer.pause(0.5);
}

void ViewerTest::scrollToTop(const DrivenViewer& viewer) {
    constexpr int kRim = 3, kToTop = 40;
    viewer.moveTo({kRim, screenPixels().y / 2});
    viewer.wheel(kToTop);
    viewer.pause(0.5);
}

void ViewerTest::toggle(const DrivenViewer& viewer, Section section) {
    const int bar = barOf(viewer, section);
    const auto above = [&] { return viewer.capture().part({0, 0}, {kPanelPixels, bar - 12}); };
    const Shot before = above();
    viewer.click({200, bar});
    viewer.moveTo(middlePixel()); // nothing is highlighted there
    viewer.pause(0.5);
    if (above() == before) return;
    scrollToTop(viewer); // scrolls a section that opens low into view
    viewer.moveTo(middlePixel());
    viewer.pause(0.3);
}

void ViewerTest::addLight(const DrivenViewer& viewer) {
    toggle(viewer, Section::Lights);
    viewer.click(inRow(viewer, Section::Lights, 1, 50));
}

void ViewerTest::chooseScene(const DrivenViewer& viewer, std::string_view builtin) {
    const auto index = std::find(std::begin(kBuiltin), std::end(kBuiltin), builtin) - std::begin(kBuiltin);
    chooseEntry(viewer, inRow(viewer, Section::Scene, 1, 200), kFirstEntryPixels + int(index) * kEntryPixels);
    viewer.moveTo(middlePixel()); // no tooltip appears there
}

void ViewerTest::chooseRecentScene(const DrivenViewer& viewer, int index) {
    const int entry = int(std::size(kBuiltin)) + index;
    chooseEntry(viewer, inRow(viewer, Section::Scene, 1, 200), kFirstEntryPixels + entry * kEntryPixels + kLinePixels);
    viewer.moveTo(middlePixel());
}

std::string ViewerTest::saveScene(const DrivenViewer& viewer) {
    const std::size_t mark = viewer.mark();
    viewer.key("ctrl+s");
    const std::string file = savedFile(viewer.waitFor("saved ", mark));
    viewer.key("Escape");
    viewer.pause(0.3);
    return file;
}

nlohmann::json ViewerTest::readJson(const std::string& name) const {
    return nlohmann::json::parse(shell("cat '" + name + "'"));
}

std::string ViewerTest::shell(const std::string& script) const {
    const std::string whole = fmt::format("tessera() {{ '{}' \"$@\"; }}\n{}", TESSERA_PROGRAM, script);
    const ProcessResult result = runProcess({"sh", "-c", whole}, {folder_.path(), {}, 120.0});
    EXPECT_EQ(result.exitCode, 0) << script << "\n" << result.err;
    return result.out;
}

std::string ViewerTest::asOpened(const std::string& builtin, glm::ivec2 sizePixels) {
    const double narrower = 16.0 / 9.0 / (double(sizePixels.x) / double(sizePixels.y));
    if (narrower <= 1.0) return builtin;
    const double halfHeight = std::tan(0.5 * scenes::loadScene(builtin).cameras.front().fovYRadians) * narrower;
    const double tenths = std::ceil(10.0 * glm::degrees(2.0 * std::atan(halfHeight)));
    return fmt::format("{} --fov {}", builtin, tenths / 10.0);
}

Shot ViewerTest::rendered(const std::string& arguments, glm::ivec2 sizePixels) const {
    shell(fmt::format("tessera render {} --size {}x{} -o rendered.png", arguments, sizePixels.x, sizePixels.y));
    return readShot(folder_.path() / "rendered.png");
}

Picture ViewerTest::exr(const std::string& name) const {
    return underLedger(validation::readPicture, (folder_.path() / name).string());
}

Picture ViewerTest::savedRadiance(const DrivenViewer& viewer) const {
    const std::size_t mark = viewer.mark();
    viewer.key("shift+F12");
    Picture picture = exr(savedFile(viewer.waitFor("saved ", mark)));
    viewer.key("Escape");
    viewer.pause(0.3);
    return picture;
}

} // namespace tessera::test
