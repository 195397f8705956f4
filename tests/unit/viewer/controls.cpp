#include "viewer/session/Controls.h"

#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/viewer/ControlledWindow.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

using namespace test;

TEST(Controls, twoClicksInOnePlaceSoonAfterOneAnotherRequestToTurnAboutIt) {
    State state = withLightInTheMiddle(0, 1);
    Controls controls;
    const auto click = [&](const glm::vec2& place, double seconds) {
        InputEvent press = button(place, true), release = button(place, false);
        press.heardSeconds = release.heardSeconds = seconds;
        state.requests = {};
        handle(controls, state, {press, release});
        return state.requests.turnAbout.has_value();
    };
    const glm::vec2 place(100.0f, 300.0f);
    EXPECT_FALSE(click(place, 10.0));
    ASSERT_TRUE(state.requests.pick);
    EXPECT_TRUE(click(place + glm::vec2(1.0f, 0.0f), 10.3));
    EXPECT_FALSE(state.requests.pick);
    EXPECT_EQ(*state.requests.turnAbout, glm::vec2(101.0f, 300.0f) / 400.0f);
    EXPECT_FALSE(click(place, 10.5)) << "the third begins anew";
    EXPECT_FALSE(click(place, 11.5)) << "too late";
    EXPECT_FALSE(click({100.0f, 320.0f}, 11.6)) << "elsewhere";
}

TEST(Controls, ctrlAndTheWheelMagnifyPixelsAboutThePointerAndDragsMoveThePicture) {
    State state = withLightInTheMiddle(0, 1);
    state.selectedLight = 0;
    state.inspects = true;
    Controls controls;
    const CameraPose pose = state.open->rig().pose();
    const glm::vec2 pointer(100.0f, 300.0f), dragged = pointer + glm::vec2(40.0f, 0.0f);
    const auto wheel = [&](float steps, int modifiers) {
        handle(controls, state, {scroll(pointer, steps, modifiers)});
    };
    EXPECT_TRUE(selectedFigure(state, kArea));
    wheel(1.0f, kControl);
    wheel(1.0f, 0); // continues the magnification
    EXPECT_EQ(state.magnification.times, 4);
    EXPECT_EQ(placeAt(state, kArea, pointer), glm::vec2(0.25f, 0.75f)) << "the pixel under the pointer stays there";
    EXPECT_EQ(pointOf(state, kArea, glm::vec2(0.25f, 0.75f)), pointer);
    EXPECT_FALSE(selectedFigure(state, kArea)) << "handles would be elsewhere";
    EXPECT_TRUE(lightMarkers(state, kArea).empty());
    for (const InputEvent& event : {button(pointer, true), moveTo(dragged), button(dragged, false)})
        handle(controls, state, {event});
    EXPECT_EQ(placeAt(state, kArea, dragged), glm::vec2(0.25f, 0.75f)) << "it follows the pointer";
    EXPECT_EQ(state.inspectedPlace(), glm::vec2(0.25f, 0.75f));
    for (int i = 0; i < 20; ++i) wheel(1.0f, 0);
    EXPECT_EQ(state.magnification.times, Magnification::kMost);
    for (int i = 0; i < 20; ++i) wheel(-1.0f, kControl);
    EXPECT_EQ(state.magnification.times, 1);
    EXPECT_EQ(state.magnification.corner, glm::vec2(0.0f));
    EXPECT_EQ(state.open->rig().pose(), pose);
    EXPECT_TRUE(state.open->rig().isAtRest());
}

TEST(Controls, whatIsInspectedIsUnderThePointerAndElseWhatIsPinned) {
    State state = withLightInTheMiddle(0, 1);
    Controls controls;
    const auto pointTo = [&](const glm::vec2& place, bool isAtPanel) {
        handle(controls, state, {moveTo(place)}, {.mouse = isAtPanel});
        return state.inspectedPlace();
    };
    EXPECT_FALSE(pointTo({100.0f, 300.0f}, false)) << "no request";
    state.inspects = true;
    EXPECT_EQ(pointTo({100.0f, 300.0f}, false), glm::vec2(0.25f, 0.75f));
    EXPECT_FALSE(pointTo({100.0f, 300.0f}, true));
    EXPECT_FALSE(pointTo({500.0f, 300.0f}, false)) << "beside the picture";
    state.pinnedPlace = glm::vec2(0.5f);
    EXPECT_EQ(pointTo({100.0f, 300.0f}, true), glm::vec2(0.5f));
    EXPECT_EQ(pointTo({100.0f, 300.0f}, false), glm::vec2(0.25f, 0.75f));
    EXPECT_FALSE(state.pinnedPlace) << "the pointer took its place";
}

TEST(Controls, theMiddleAndTheRightButtonMoveAcrossThePictureTheLatterWithoutShift) {
    const auto isMovedBy = [](int code, int modifiers) {
        State state = withLightInTheMiddle(0, 1);
        EXPECT_TRUE(state.open->rig().isAtRest());
        Controls controls;
        handle(controls, state, {button({200.0f, 200.0f}, true, code, modifiers), moveTo({300.0f, 200.0f})});
        EXPECT_EQ(state.selectedLight, scenes::kNone) << "the light in the middle is not taken";
        return !state.open->rig().isAtRest();
    };
    EXPECT_TRUE(isMovedBy(kRightButton, 0));
    EXPECT_TRUE(isMovedBy(kMiddleButton, 0));
    EXPECT_FALSE(isMovedBy(kRightButton, kShift)) << "that turns the environment, and there is none";
}

TEST(Controls, theWheelOverThePictureSetsTheSpeedOfWhoFlies) {
    State state = withLightInTheMiddle(0, 1);
    CameraRig& rig = state.open->rig();
    rig.setMode(CameraRig::Mode::Fly);
    const InputEvent towardsTheUser = scroll({100.0f, 300.0f}, -2.0f);
    Controls controls;
    const double usual = rig.flyMetresPerSecond();
    handle(controls, state, {towardsTheUser}, {.mouse = true});
    EXPECT_EQ(rig.flyMetresPerSecond(), usual) << "it scrolls the panels";
    handle(controls, state, {towardsTheUser});
    EXPECT_DOUBLE_EQ(rig.flyMetresPerSecond(), 0.5 * usual);
    EXPECT_FALSE(rig.isMoved());
}

TEST(Controls, shiftAndTheRightButtonTurnTheEnvironmentAndNothingWhereThereIsNone) {
    State state = withLightInTheMiddle(0, 1);
    std::string said;
    const auto dragged = [&](int modifiers) {
        const glm::vec2 end(300.0f, 200.0f);
        Controls controls;
        handle(controls, state,
               {button({200.0f, 200.0f}, true, kRightButton, modifiers), moveTo({250.0f, 200.0f}), moveTo(end)});
        said = state.dragText;
        handle(controls, state, {button(end, false, kRightButton)});
        EXPECT_EQ(state.dragText, "");
        return state.looks[0].settings.environment.rotationDegrees;
    };
    EXPECT_EQ(dragged(kShift), 0.0f);
    ChosenEnvironment chosen;
    chosen.environment.emplace();
    state.open->takeEnvironment(std::move(chosen));
    EXPECT_EQ(dragged(0), 0.0f);
    EXPECT_EQ(said, "");
    EXPECT_EQ(dragged(kShift), 45.0f); // a quarter of the image's height
    EXPECT_EQ(said, "Environment 45.0\xc2\xb0");
    EXPECT_EQ(*state.open->history().undoText(), "turn the environment");
    EXPECT_EQ(dragged(kShift), 90.0f);
    EXPECT_EQ(state.open->history().undoable(), 3u) << "a step a drag, after the choice of the environment";
    for (const float degrees : {45.0f, 0.0f}) {
        undo(state);
        for (const Look& look : state.looks) EXPECT_EQ(look.settings.environment.rotationDegrees, degrees);
    }
    redo(state);
    EXPECT_EQ(state.looks[0].settings.environment.rotationDegrees, 45.0f);
}

TEST(Controls, aQuestionIsAnsweredByItsKeysAndByNothingElse) {
    State state;
    Controls controls;
    const auto answerTo = [&](int code, int modifiers) {
        handle(controls, state, {key(code, modifiers)});
        return std::exchange(state.requests.answer, std::nullopt);
    };
    EXPECT_FALSE(answerTo('D', 0)) << "no question is open";
    state.question = Question{};
    EXPECT_EQ(answerTo('S', 0), Answer::Keep);
    EXPECT_EQ(answerTo('D', 0), Answer::Discard);
    EXPECT_EQ(answerTo(kEscapeKey, 0), Answer::Cancel);
    EXPECT_FALSE(answerTo('Q', kControl));
    EXPECT_FALSE(state.requests.quit) << "the same request again is no answer";
    EXPECT_FALSE(answerTo('S', kControl));
    EXPECT_FALSE(state.requests.saveScene);
    state.question->about = Question::About::Recovering;
    EXPECT_EQ(answerTo('R', 0), Answer::Keep);
}

TEST(Controls, keysWithControlGoByTheLetterOnThemAndOthersByTheirPlace) {
    State state = withLightInTheMiddle(0, 1);
    state.selectedLight = 0;
    deleteSelectedLights(state);
    Controls controls;
    const auto pressed = [&](int place, int letter, int modifiers) {
        handle(controls, state, {key(place, modifiers, letter)});
        return state.open->scene().lights.size();
    };
    EXPECT_EQ(pressed('Y', 'Z', kControl), 1u) << "undo, on a German keyboard";
    EXPECT_EQ(pressed('Z', 'Y', kControl), 0u) << "redo";
    EXPECT_EQ(pressed('Z', 0, kControl), 1u) << "where the layout has no letter, its place counts";
    state.compare = Compare::Split;
    pressed('Z', 'Y', 0);
    EXPECT_EQ(state.activeSide, 1) << "the other side of a comparison";
}

TEST(Controls, theEdgeOfThePanelsIsDraggedWithinBounds) {
    State state;
    constexpr PictureArea kBeside{{300.0f, 0.0f}, {700.0f, 500.0f}};
    Controls controls;
    const auto press = [&](float x, bool down) { handle(controls, state, {button({x, 200.0f}, down)}, {}, kBeside); };
    const auto widthAt = [&](float x) {
        handle(controls, state, {moveTo({x, 200.0f})}, {}, kBeside);
        return state.panelWidth;
    };
    press(310.0f, true); // within the image
    EXPECT_EQ(widthAt(400.0f), kUsualPanelWidth);
    press(400.0f, false);
    press(301.0f, true);
    EXPECT_TRUE(state.isPanelEdgeHeld);
    EXPECT_EQ(widthAt(420.3f), 420.0f);
    EXPECT_EQ(widthAt(3.0f), kLeastPanelWidth);
    EXPECT_EQ(widthAt(2000.0f), 800.0f) << "a fifth of the window is left to the picture";
    press(2000.0f, false);
    EXPECT_FALSE(state.isPanelEdgeHeld);
    EXPECT_FALSE(state.isDragging);
    EXPECT_EQ(widthAt(500.0f), 800.0f);
}

TEST(Controls, whileTheDialogOfFilesIsOpenKeysAndThePictureWait) {
    State state = withLightInTheMiddle(0, 1);
    state.files.emplace(FileDialog::Purpose::Open, "/");
    EXPECT_EQ(selectedByPress(state), scenes::kNone);
    Controls controls;
    handle(controls, state, {key('M')});
    EXPECT_TRUE(state.showsMarkers) << "M would hide them";
    EXPECT_TRUE(state.files);
    handle(controls, state, {key(kEscapeKey)}, {.keyboard = true});
    EXPECT_FALSE(state.files);
}

} // namespace
} // namespace tessera::viewer
