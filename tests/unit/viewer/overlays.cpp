// Overlays of the interface on the image.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/InspectorBox.h"
#include "viewer/panels/Legend.h"
#include "viewer/panels/Overlays.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/session/DrawnLook.h"

namespace tessera::viewer {
namespace {

class Overlays : public test::PanelTest {
protected:
    /// Returns the status line, with the panels hidden.
    std::string statusLine(State& state, const Facts& facts = {}) {
        state.showsPanel = false;
        return firstWindowText(state, facts);
    }
};

using testing::HasSubstr;
using testing::Not;

TEST_F(Overlays, thePointerSaysThatTheDividerCanBeDragged) {
    State state;
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const PictureArea place = area(state);
    const float dividerX = place.corner.x + 0.6f * place.size.x;
    const auto cursorAt = [&](float x) {
        return PanelTest::cursorAt({x, 100.0f}, [&] { drawDivider(state, place, 1.0f); });
    };
    EXPECT_EQ(cursorAt(dividerX + 2.0f), ImGuiMouseCursor_ResizeEW);
    EXPECT_EQ(cursorAt(dividerX + 20.0f), ImGuiMouseCursor_Arrow);
    state.isDividerHeld = true;
    EXPECT_EQ(cursorAt(dividerX + 20.0f), ImGuiMouseCursor_ResizeEW) << "it is held, wherever the pointer went";
    state = {};
    EXPECT_EQ(cursorAt(dividerX), ImGuiMouseCursor_Arrow) << "there is none";
}

TEST_F(Overlays, theInspectorStaysInThePictureAndHasALoupeForEachSide) {
    State state;
    const PictureArea place = area(state);
    Facts facts;
    const auto span = [&] {
        state.loupes.clear();
        return overlaySpan([&] { drawInspector(state, facts, place); });
    };
    state.pointedPlace = glm::vec2(0.5f);
    facts.inspection.emplace().sides[0].emplace();
    EXPECT_FALSE(span()) << "nothing is inspected";
    state.inspects = true;
    for (const float share : {0.0f, 0.5f, 0.999f}) {
        state.pointedPlace = glm::vec2(share);
        const auto drawn = span();
        ASSERT_TRUE(drawn);
        EXPECT_GE(drawn->first, place.corner.x - 2.0f);
        EXPECT_LE(drawn->second, place.corner.x + place.size.x + 2.0f);
        ASSERT_EQ(state.loupes.size(), 1u);
        EXPECT_TRUE(place.contains(state.loupes[0].corner));
        EXPECT_TRUE(place.contains(state.loupes[0].corner + state.loupes[0].size));
    }
    facts.inspection->sides[1].emplace();
    EXPECT_TRUE(span());
    ASSERT_EQ(state.loupes.size(), 2u);
    EXPECT_EQ(state.loupes[1].side, 1);
    EXPECT_GE(state.loupes[1].corner.x, state.loupes[0].corner.x + state.loupes[0].size);
}

TEST_F(Overlays, theScaleOfCountsStandsOnTheSideThatShowsThem) {
    State state;
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const PictureArea place = area(state);
    const float dividerX = place.corner.x + 0.6f * place.size.x, endX = place.corner.x + place.size.x;
    Facts facts;
    const auto span = [&] { return overlaySpan([&] { drawLegend(state, facts, place, 1.0f); }); };
    facts.shown = {test::lookAt(frame::DebugView::Lights), test::lookAt(frame::DebugView::Final)};
    ASSERT_TRUE(span());
    EXPECT_GT(span()->first, place.corner.x);
    EXPECT_LT(span()->second, dividerX);
    std::swap(facts.shown[0], facts.shown[1]);
    ASSERT_TRUE(span());
    EXPECT_GT(span()->first, dividerX);
    EXPECT_LT(span()->second, endX);
}

TEST_F(Overlays, theScaleOfCountsEndsAtTheLargestThatThePictureHas) {
    State state;
    Facts facts;
    facts.shown[0] = test::lookAt(frame::DebugView::Lights);
    /// Red of the bar's brightest colour; nothing else is coloured.
    const auto brightest = [&] {
        int most = 0;
        for (const ImDrawVert& vertex : overlay([&] { drawLegend(state, facts, area(state), 1.0f); })) {
            const int red = int(vertex.col & 0xffu), blue = int(vertex.col >> 16 & 0xffu);
            if (red - blue > 40) most = std::max(most, red);
        }
        return most;
    };
    EXPECT_GT(brightest(), 240) << "the whole scale, to pale yellow";
    facts.mostCounts[0] = {frame::DebugView::Lights, 5.0f};
    EXPECT_GT(brightest(), 240) << "the colours fit";
    EXPECT_EQ(countColorsLog2(state, facts, 0, frame::DebugView::Lights), 3.0f) << "0 to 7 differ at least";
    facts.mostCounts[0]->most = 31.0f;
    EXPECT_EQ(countColorsLog2(state, facts, 0, frame::DebugView::Lights), 5.0f);
    EXPECT_EQ(countColorsLog2(state, facts, 1, frame::DebugView::Lights), 9.0f) << "nothing is known of that side";
    facts.mostCounts[0]->most = 5.0f;
    state.fitsCountColors = false;
    EXPECT_LT(brightest(), 200) << "of 512 lights, 5 are dark";
    facts.mostCounts[0]->view = frame::DebugView::Overdraw;
    EXPECT_GT(brightest(), 240) << "it is that of another view";
}

TEST_F(Overlays, whatNamesThePictureFollowsTheShownOneAndNotTheChosenOne) {
    State state;
    state.looks[0] = test::lookAt(frame::DebugView::Lights); // selected, but its shaders are still compiling
    Facts facts;
    facts.shown[0] = test::lookAt(frame::DebugView::Normal);
    facts.isPreparing = true;
    const std::string status = statusLine(state, facts);
    EXPECT_THAT(status, HasSubstr(lookName(*facts.shown[0])));
    EXPECT_THAT(status, Not(HasSubstr(lookName(state.looks[0]))));
    EXPECT_FALSE(overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }));
    std::swap(state.looks[0], *facts.shown[0]);
    EXPECT_TRUE(overlaySpan([&] { drawLegend(state, facts, area(state), 1.0f); }));
}

TEST_F(Overlays, theStatusLineSaysThatTheCameraFliesAndHowFast) {
    State state = test::unusualScene();
    EXPECT_THAT(statusLine(state), Not(HasSubstr("flying")));
    CameraRig& rig = state.open->rig();
    rig.setMode(CameraRig::Mode::Fly);
    const auto said = [&] { return fmt::format("flying, {:.3g} m/s (C: orbit)", rig.flyMetresPerSecond()); };
    const std::string usual = said();
    EXPECT_THAT(statusLine(state), HasSubstr(usual));
    rig.wheel(2.0, {}, 1000.0);
    EXPECT_NE(said(), usual);
    EXPECT_THAT(statusLine(state), HasSubstr(said()));
}

TEST_F(Overlays, theStatusLineSaysWhatGoesOnAndNothingOfWhatDoesNot) {
    struct Case {
        const char *word, *whole;
        void (*set)(Facts&);
    };
    const Case kCases[] = {
        {"diffusing", "diffusing light: 1 of 3 objects, 45 %",
         [](Facts& facts) { facts.diffusion = {.objects = 3, .doneObjects = 1, .tiles = 200, .doneTiles = 90}; }},
        {"cancelled", "cancelled (Enter: draw on)", [](Facts& facts) { facts.isCancelled = true; }},
        {"frames/s", "24 frames/s", [](Facts& facts) { facts.picturesPerSecond = 24.4; }}};
    for (const Case& one : kCases) {
        State state;
        Facts facts;
        facts.scale = 1.0;
        EXPECT_THAT(statusLine(state, facts), Not(HasSubstr(one.word)));
        one.set(facts);
        EXPECT_THAT(statusLine(state, facts), HasSubstr(one.whole));
    }
}

TEST_F(Overlays, theBoxOfProgressStandsInThePictureAndCoversItself) {
    State state;
    state.showsPanel = false;
    const PictureArea place = area(state);
    std::optional<Box> other;
    const auto boxOf = [&](const Progress& progress) {
        return overlaySpan([&] { drawProgress(progress, place, other, 1.0f, *ImGui::GetBackgroundDrawList()); });
    };
    const auto unknown = boxOf({"Preparing shaders", {}, true});
    ASSERT_TRUE(unknown);
    EXPECT_GE(unknown->first, place.corner.x);
    EXPECT_LE(unknown->second, place.corner.x + place.size.x);
    EXPECT_EQ(boxOf({"Drawing the whole picture", 0.5, false}), unknown);
    EXPECT_EQ(boxOf({"Drawing the whole picture", 7.0, true}), unknown) << "more than all";
    EXPECT_LT(unknown->second, place.corner.x + 0.5f * place.size.x) << "it hides the object";
    other = Box{place.corner + glm::vec2(0.0f, 0.8f * place.size.y), 0.2f * place.size};
    const auto beside = boxOf({"Preparing shaders", {}, true});
    ASSERT_TRUE(beside);
    EXPECT_GT(beside->first, other->corner.x + other->size.x) << "it covers the inspector";
    PictureArea narrow = place;
    narrow.size = {50.0f, 20.0f};
    EXPECT_FALSE(overlaySpan([&] {
        drawProgress({"x", 0.5, true}, narrow, {}, 1.0f, *ImGui::GetBackgroundDrawList());
    }));
}

TEST_F(Overlays, aViewIsNamedInItsPictureAndTheLitPictureIsLeftFree) {
    State state;
    Facts facts;
    const auto names = [&] { return overlaySpan([&] { drawNames(state, facts, area(state), 1.0f); }); };
    facts.shown[0] = test::lookAt(frame::DebugView::Final);
    EXPECT_FALSE(names());
    facts.shown[0] = test::lookAt(frame::DebugView::Geometry);
    ASSERT_TRUE(names());
    EXPECT_GE(names()->first, area(state).corner.x);
    EXPECT_LE(names()->second, area(state).corner.x + area(state).size.x);
    // On each side of the divider the name stays within its side.
    state.compare = Compare::Split;
    state.divider = 0.6f;
    const float dividerX = area(state).corner.x + 0.6f * area(state).size.x;
    facts.shown[1] = test::lookAt(frame::DebugView::Lights);
    ASSERT_TRUE(names());
    EXPECT_LT(names()->first, dividerX);
    EXPECT_GT(names()->second, dividerX);
    // A difference shows the names of both images.
    state.compare = Compare::Difference;
    EXPECT_TRUE(names());
    facts.shown[1].reset();
    EXPECT_FALSE(names()) << "there is nothing to differ from";
}

TEST_F(Overlays, aDifferenceOfNothingIsSaidOnItsBlackPicture) {
    State state;
    state.compare = Compare::Difference;
    Facts facts;
    const auto isSaid = [&] { return overlaySpan([&] { drawNames(state, facts, area(state), 1.0f); }).has_value(); };
    EXPECT_FALSE(isSaid());
    facts.figures.emplace().bitEqual = 1.0;
    EXPECT_TRUE(isSaid());
    facts.figuresAreOld = true;
    EXPECT_FALSE(isSaid());
    facts.figuresAreOld = false;
    facts.figures->bitEqual = 0.999;
    EXPECT_FALSE(isSaid());
}

} // namespace
} // namespace tessera::viewer
