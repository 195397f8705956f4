#include "viewer/session/Controls.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/viewer/ControlledWindow.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

using test::kArea;
using test::selectedByPress;
using test::withLightInTheMiddle;

TEST(Controls, twoClicksInOnePlaceSoonAfterOneAnotherAskToTurnAboutIt) {
    State state = withLightInTheMiddle(0, 1);
    Controls controls;
    const auto click = [&](const glm::vec2& place, double seconds) {
        InputEvent press, release;
        press.kind = release.kind = InputEvent::Kind::Button;
        press.down = true;
        press.position = release.position = place;
        press.heardSeconds = release.heardSeconds = seconds;
        state.requests = {};
        controls.handle(std::array{press, release}, state, kArea, {});
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
    const auto handle = [&](const InputEvent& event) { controls.handle(std::span(&event, 1), state, kArea, {}); };
    const glm::vec2 pointer(100.0f, 300.0f);
    const auto wheel = [&](float steps, int modifiers) {
        InputEvent event;
        event.kind = InputEvent::Kind::Scroll;
        event.position = pointer;
        event.scroll = {0.0f, steps};
        event.modifiers = modifiers;
        handle(event);
    };
    EXPECT_TRUE(selectedFigure(state, kArea));
    wheel(1.0f, 2); // GLFW's Ctrl
    wheel(1.0f, 0); // goes on with it
    EXPECT_EQ(state.magnification.times, 4);
    EXPECT_EQ(placeAt(state, kArea, pointer), glm::vec2(0.25f, 0.75f)) << "the pixel under the pointer stays there";
    EXPECT_EQ(pointOf(state, kArea, glm::vec2(0.25f, 0.75f)), pointer);
    EXPECT_FALSE(selectedFigure(state, kArea)) << "handles would be elsewhere";
    EXPECT_TRUE(lightMarkers(state, kArea).empty());
    InputEvent press, move, release;
    press.kind = release.kind = InputEvent::Kind::Button;
    press.down = true;
    press.position = pointer;
    move.position = release.position = pointer + glm::vec2(40.0f, 0.0f);
    for (const InputEvent& event : {press, move, release}) handle(event);
    EXPECT_EQ(placeAt(state, kArea, move.position), glm::vec2(0.25f, 0.75f)) << "it follows the pointer";
    EXPECT_EQ(state.inspectedPlace(), glm::vec2(0.25f, 0.75f));
    for (int i = 0; i < 20; ++i) wheel(1.0f, 0);
    EXPECT_EQ(state.magnification.times, Magnification::kMost);
    for (int i = 0; i < 20; ++i) wheel(-1.0f, 2);
    EXPECT_EQ(state.magnification.times, 1);
    EXPECT_EQ(state.magnification.corner, glm::vec2(0.0f));
    EXPECT_EQ(state.open->rig().pose(), pose);
    EXPECT_TRUE(state.open->rig().isAtRest());
}

TEST(Controls, whatIsInspectedIsUnderThePointerAndElseWhatIsPinned) {
    State state = withLightInTheMiddle(0, 1);
    Controls controls;
    const auto pointTo = [&](const glm::vec2& place, bool isAtPanel) {
        InputEvent move;
        move.kind = InputEvent::Kind::Move;
        move.position = place;
        controls.handle(std::span(&move, 1), state, kArea, {.mouse = isAtPanel});
        return state.inspectedPlace();
    };
    EXPECT_FALSE(pointTo({100.0f, 300.0f}, false)) << "nobody asked";
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
    const auto isMovedBy = [](int button, int modifiers) {
        State state = withLightInTheMiddle(0, 1);
        EXPECT_TRUE(state.open->rig().isAtRest());
        InputEvent press, move;
        press.kind = InputEvent::Kind::Button;
        press.code = button;
        press.modifiers = modifiers;
        press.down = true;
        press.position = {200.0, 200.0};
        move.kind = InputEvent::Kind::Move;
        move.position = {300.0, 200.0};
        Controls controls;
        controls.handle(std::array{press, move}, state, kArea, {});
        EXPECT_EQ(state.selectedLight, scenes::kNone) << "the light in the middle is not taken";
        return !state.open->rig().isAtRest();
    };
    constexpr int kRight = 1, kMiddle = 2, kShift = 1; // GLFW's
    EXPECT_TRUE(isMovedBy(kRight, 0));
    EXPECT_TRUE(isMovedBy(kMiddle, 0));
    EXPECT_FALSE(isMovedBy(kRight, kShift)) << "that turns the environment, and there is none";
}

TEST(Controls, theWheelOverThePictureSetsTheSpeedOfWhoFlies) {
    State state = withLightInTheMiddle(0, 1);
    CameraRig& rig = state.open->rig();
    rig.setMode(CameraRig::Mode::Fly);
    InputEvent scroll;
    scroll.kind = InputEvent::Kind::Scroll;
    scroll.position = {100.0f, 300.0f};
    scroll.scroll = {0.0f, -2.0f}; // towards the user
    Controls controls;
    const double usual = rig.flyMetresPerSecond();
    controls.handle(std::span(&scroll, 1), state, kArea, {.mouse = true});
    EXPECT_EQ(rig.flyMetresPerSecond(), usual) << "it scrolls the panels";
    controls.handle(std::span(&scroll, 1), state, kArea, {});
    EXPECT_DOUBLE_EQ(rig.flyMetresPerSecond(), 0.5 * usual);
    EXPECT_FALSE(rig.isMoved());
}

TEST(Controls, shiftAndTheRightButtonTurnTheEnvironmentAndNothingWhereThereIsNone) {
    State state = withLightInTheMiddle(0, 1);
    std::string said;
    const auto dragged = [&](int modifiers) {
        InputEvent press, move, end, release;
        press.kind = release.kind = InputEvent::Kind::Button;
        press.code = release.code = 1; // GLFW's right one
        press.modifiers = modifiers;
        press.down = true;
        press.position = {200.0, 200.0};
        move.kind = end.kind = InputEvent::Kind::Move;
        move.position = {250.0, 200.0};
        end.position = release.position = {300.0, 200.0};
        const std::array began{press, move, end};
        Controls controls;
        controls.handle(began, state, kArea, {});
        said = state.dragText;
        controls.handle(std::span(&release, 1), state, kArea, {});
        EXPECT_EQ(state.dragText, "");
        return state.looks[0].settings.environment.rotationDegrees;
    };
    constexpr int kShift = 1; // GLFW's
    EXPECT_EQ(dragged(kShift), 0.0f);
    ChosenEnvironment chosen;
    chosen.environment.emplace();
    state.open->takeEnvironment(std::move(chosen));
    EXPECT_EQ(dragged(0), 0.0f);
    EXPECT_EQ(said, "");
    EXPECT_EQ(dragged(kShift), 45.0f); // a quarter of the picture's height
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
    const auto answerTo = [&](int key, int modifiers) {
        InputEvent event;
        event.kind = InputEvent::Kind::Key;
        event.code = key;
        event.modifiers = modifiers;
        event.down = true;
        controls.handle(std::span(&event, 1), state, kArea, {});
        return std::exchange(state.requests.answer, std::nullopt);
    };
    constexpr int kControl = 2, kEscape = 256; // GLFW's
    EXPECT_FALSE(answerTo('D', 0)) << "nothing was asked";
    state.question = Question{};
    EXPECT_EQ(answerTo('S', 0), Answer::Keep);
    EXPECT_EQ(answerTo('D', 0), Answer::Discard);
    EXPECT_EQ(answerTo(kEscape, 0), Answer::Cancel);
    EXPECT_FALSE(answerTo('Q', kControl));
    EXPECT_FALSE(state.requests.quit) << "to ask for the same again is no answer";
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
        InputEvent event;
        event.kind = InputEvent::Kind::Key;
        event.code = place;
        event.letter = letter;
        event.modifiers = modifiers;
        event.down = true;
        controls.handle(std::span(&event, 1), state, kArea, {});
        return state.open->scene().lights.size();
    };
    constexpr int kControl = 2; // GLFW's
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
    const auto tell = [&](InputEvent::Kind kind, float x, bool isDown) {
        InputEvent event;
        event.kind = kind;
        event.down = isDown;
        event.position = {x, 200.0f};
        controls.handle(std::span(&event, 1), state, kBeside, {});
    };
    tell(InputEvent::Kind::Button, 310.0f, true); // in the picture
    tell(InputEvent::Kind::Move, 400.0f, true);
    tell(InputEvent::Kind::Button, 400.0f, false);
    EXPECT_EQ(state.panelWidth, kUsualPanelWidth);
    tell(InputEvent::Kind::Button, 301.0f, true);
    EXPECT_TRUE(state.isPanelEdgeHeld);
    tell(InputEvent::Kind::Move, 420.3f, true);
    EXPECT_EQ(state.panelWidth, 420.0f);
    tell(InputEvent::Kind::Move, 3.0f, true);
    EXPECT_EQ(state.panelWidth, kLeastPanelWidth);
    tell(InputEvent::Kind::Move, 2000.0f, true);
    EXPECT_EQ(state.panelWidth, 800.0f) << "a fifth of the window is left to the picture";
    tell(InputEvent::Kind::Button, 2000.0f, false);
    EXPECT_FALSE(state.isPanelEdgeHeld);
    EXPECT_FALSE(state.isDragging);
    tell(InputEvent::Kind::Move, 500.0f, false);
    EXPECT_EQ(state.panelWidth, 800.0f);
}

TEST(Controls, whileTheDialogOfFilesAsksKeysAndThePictureWait) {
    State state = withLightInTheMiddle(0, 1);
    state.files.emplace(FileDialog::Purpose::Open, "/");
    EXPECT_EQ(selectedByPress(state), scenes::kNone);
    InputEvent key;
    key.kind = InputEvent::Kind::Key;
    key.down = true;
    key.code = 'M';
    Controls controls;
    controls.handle(std::span(&key, 1), state, kArea, {});
    EXPECT_TRUE(state.showsMarkers) << "M would hide them";
    EXPECT_TRUE(state.files);
    key.code = 256; // GLFW's Escape
    controls.handle(std::span(&key, 1), state, kArea, {.keyboard = true});
    EXPECT_FALSE(state.files);
}

} // namespace
} // namespace tessera::viewer
