#include "viewer/session/Controls.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "viewer/edit/LightList.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr PictureArea kArea{{0.0f, 0.0f}, {400.0f, 400.0f}};

/// A window whose scene has a light in the picture's middle and others out of view.
State withLightInTheMiddle(std::size_t index, std::size_t count) {
    scenes::LoadOptions load;
    scenes::Scene scene = scenes::loadScene("room", load);
    const glm::dmat4& worldFromCamera = scene.cameras.front().worldFromCamera;
    scene.lights.assign(count, scenes::Light());
    for (scenes::Light& light : scene.lights) light.positionWS = worldFromCamera * glm::dvec4(0, 0, 5, 1);
    scene.lights[index].positionWS = worldFromCamera * glm::dvec4(0, 0, -1, 1);
    State state;
    state.open = std::make_unique<OpenScene>("room", load, std::move(scene), scenes::SceneOrigin());
    state.showsMarkers = true;
    return state;
}

/// What is selected after a button was pressed in the picture's middle.
int selectedByPress(State& state) {
    InputEvent press;
    press.kind = InputEvent::Kind::Button;
    press.code = 0; // GLFW's left one
    press.down = true;
    press.position = {200.0, 200.0};
    Controls controls;
    controls.handle(std::span(&press, 1), state, kArea, {});
    return state.selectedLight;
}

TEST(Controls, aLightIsGrabbedByItsMarkerAndNeverWithoutOne) {
    State shown = withLightInTheMiddle(kMostMarkers - 1, kMostMarkers + 2);
    EXPECT_EQ(selectedByPress(shown), int(kMostMarkers) - 1);
    State beyond = withLightInTheMiddle(kMostMarkers, kMostMarkers + 2);
    EXPECT_EQ(selectedByPress(beyond), scenes::kNone);
    beyond.selectedLight = int(kMostMarkers); // which is marked whatever its number
    EXPECT_EQ(selectedByPress(beyond), int(kMostMarkers));
    State hidden = withLightInTheMiddle(0, 1);
    hidden.showsMarkers = false;
    EXPECT_EQ(selectedByPress(hidden), scenes::kNone);
}

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

/// The window with a rectangle in the picture's middle that is selected: 200 wide in the picture, seen from its edge.
State withRectangleSelected() {
    State state = withLightInTheMiddle(0, 1);
    state.selectedLight = 0;
    scenes::Scene scene = state.open->scene();
    const glm::dmat4& worldFromCamera = scene.cameras.front().worldFromCamera;
    scenes::Light& light = scene.lights[0];
    light.type = scenes::LightType::Rectangle;
    light.directionWS = -glm::dvec3(worldFromCamera[1]);
    light.alongWS = glm::dvec3(worldFromCamera[0]);
    light.widthMetres = float(200.0 * viewOf(state, kArea).metresPerUnit(light.positionWS).value());
    state.open = std::make_unique<OpenScene>("room", scenes::LoadOptions(), std::move(scene), scenes::SceneOrigin());
    return state;
}
constexpr glm::vec2 kRightSide{300.0f, 200.0f};

InputEvent pointerEvent(InputEvent::Kind kind, glm::vec2 position, bool down = false) {
    InputEvent event;
    event.kind = kind;
    event.position = position;
    event.down = down;
    return event;
}

/// The left button.
void press(Controls& controls, State& state, glm::vec2 position, bool down) {
    const InputEvent event = pointerEvent(InputEvent::Kind::Button, position, down);
    controls.handle(std::span(&event, 1), state, kArea, {});
}
void moveTo(Controls& controls, State& state, glm::vec2 position) {
    const InputEvent event = pointerEvent(InputEvent::Kind::Move, position);
    controls.handle(std::span(&event, 1), state, kArea, {});
}

TEST(Controls, aSideOfTheSelectedLightGoesWithThePointerAndWithShiftAlone) {
    State state = withRectangleSelected();
    const scenes::Light before = state.open->scene().lights[0];
    const scenes::Light& light = state.open->scene().lights[0];
    Controls controls;
    press(controls, state, kRightSide, true);
    EXPECT_TRUE(state.heldHandle);
    EXPECT_TRUE(state.dragText.starts_with("Width ")) << state.dragText;
    EXPECT_FALSE(state.open->isEdited()) << "nothing was dragged yet";
    moveTo(controls, state, kRightSide + glm::vec2(50.0f, 0.0f));
    EXPECT_NEAR(light.widthMetres, 1.5 * double(before.widthMetres), 1e-3 * double(before.widthMetres));
    EXPECT_EQ(light.positionWS, before.positionWS);
    EXPECT_TRUE(state.open->isEdited());
    // Shift: the left side stays where it is.
    InputEvent shift;
    shift.kind = InputEvent::Kind::Key;
    shift.code = 340; // GLFW's left one
    shift.down = true;
    controls.handle(std::span(&shift, 1), state, kArea, {});
    moveTo(controls, state, kRightSide + glm::vec2(40.0f, 0.0f));
    EXPECT_NEAR(light.widthMetres, 1.2 * double(before.widthMetres), 1e-3 * double(before.widthMetres));
    const glm::dvec2 middle = viewOf(state, kArea).placeOf(light.positionWS).value();
    EXPECT_NEAR(middle.x, 220.0, 0.1);
    EXPECT_NEAR(middle.y, 200.0, 0.1);
    press(controls, state, kRightSide + glm::vec2(40.0f, 0.0f), false);
    EXPECT_FALSE(state.heldHandle);
    EXPECT_EQ(state.dragText, "");
    EXPECT_FALSE(state.requests.pick) << "it was no click";
}

TEST(Controls, aHandleEndsWithItsLight) {
    State state = withRectangleSelected();
    Controls controls;
    press(controls, state, kRightSide, true);
    deleteSelectedLights(state);
    const std::uint64_t edits = state.open->edits();
    moveTo(controls, state, kRightSide + glm::vec2(50.0f, 0.0f));
    EXPECT_FALSE(state.heldHandle);
    EXPECT_EQ(state.dragText, "");
    EXPECT_EQ(state.open->edits(), edits);
}

TEST(Controls, oneDragOfAHandleIsOneStepThatIsUndoneWhenItIsOver) {
    State state = withRectangleSelected();
    const scenes::Light before = state.open->scene().lights[0];
    Controls controls;
    press(controls, state, kRightSide, true);
    for (const float x : {10.0f, 30.0f, 50.0f}) moveTo(controls, state, kRightSide + glm::vec2(x, 0.0f));
    undo(state);
    EXPECT_FALSE(state.open->scene().lights[0] == before) << "it is held";
    press(controls, state, kRightSide + glm::vec2(50.0f, 0.0f), false);
    EXPECT_EQ(state.open->history().undoable(), 1u);
    EXPECT_EQ(*state.open->history().undoText(), "resize light '" + lightLabel(state.open->scene().lights, 0) + "'");
    undo(state);
    EXPECT_TRUE(state.open->scene().lights[0] == before);
    EXPECT_FALSE(state.open->isEdited());
}

TEST(Controls, aDragOfAnArmMovesItsLightAloneInOneStep) {
    State state = withLightInTheMiddle(0, 2);
    state.selectedLight = 0;
    state.selectedLights = {0, 1};
    const Lights before = state.open->scene().lights;
    const LightFigure figure = *selectedFigure(state, kArea);
    const auto arm = std::ranges::find(figure.handles, 0, &LightHandle::arm);
    ASSERT_NE(arm, figure.handles.end());
    const glm::vec2 place(arm->place), way(arm->way);
    Controls controls;
    press(controls, state, place, true);
    EXPECT_TRUE(state.dragText.starts_with("Position x ")) << state.dragText;
    for (const float pixels : {10.0f, 30.0f, 50.0f}) moveTo(controls, state, place + pixels * way);
    press(controls, state, place + 50.0f * way, false);
    const Lights& lights = state.open->scene().lights;
    scenes::Light expected = before[0];
    expected.positionWS.x = lights[0].positionWS.x;
    EXPECT_GT(lights[0].positionWS.x, before[0].positionWS.x);
    EXPECT_TRUE(lights[0] == expected);
    EXPECT_TRUE(lights[1] == before[1]) << "as a marker, an arm moves its own light";
    EXPECT_EQ(state.open->history().undoable(), 1u);
    EXPECT_EQ(*state.open->history().undoText(), "move light '" + lightLabel(lights, 0) + "'");
    undo(state);
    EXPECT_TRUE(state.open->scene().lights == before);
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

TEST(Controls, handlesAreTakenAsFarBesideThemAsTheDisplayIsDense) {
    const State state = withRectangleSelected();
    PictureArea dense = kArea;
    dense.scale = 2.0f;
    const glm::vec2 beside = kRightSide + glm::vec2(0.0f, 14.0f);
    EXPECT_TRUE(handleUnder(state, kArea, kRightSide));
    EXPECT_FALSE(handleUnder(state, kArea, beside));
    EXPECT_TRUE(handleUnder(state, dense, beside));
    EXPECT_FALSE(handleUnder(state, kArea, {200.0f, 200.0f})) << "there is the marker";
    PictureArea none = kArea;
    none.size = {0.0f, 0.0f};
    EXPECT_FALSE(handleUnder(state, none, kRightSide)) << "there is no picture";
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

TEST(Controls, directionalLightsHaveSunsAtThePicturesSideWhereAllAreMarked) {
    State state = withLightInTheMiddle(0, 30);
    Lights lights = state.open->scene().lights;
    for (std::size_t i = 1; i < lights.size(); ++i) lights[i].type = scenes::LightType::Directional;
    state.open->replaceLights("replace", 0, lights.size(), lights);
    const auto suns = [&] {
        int count = 0;
        for (const LightMarker& marker : lightMarkers(state, kArea)) {
            if (!marker.isSun) continue;
            ++count;
            EXPECT_EQ(marker.light, count) << "in the list's order";
            EXPECT_LT(marker.place.y, double(kArea.size.y));
        }
        return count;
    };
    EXPECT_GT(suns(), 5);
    EXPECT_LT(suns(), 29) << "there is no room for so many";
    const glm::vec2 second(lightMarkers(state, kArea).at(2).place); // after the light in the middle
    InputEvent press;
    press.kind = InputEvent::Kind::Button;
    press.down = true;
    press.position = second;
    Controls controls;
    controls.handle(std::span(&press, 1), state, kArea, {});
    EXPECT_EQ(state.selectedLight, 2);
    state.showsMarkers = false;
    EXPECT_EQ(suns(), 0);
}

TEST(Controls, allSelectedLightsAreMarkedAndHaveOutlines) {
    State state = withLightInTheMiddle(0, 3);
    Lights lights = state.open->scene().lights;
    for (scenes::Light& light : lights) light.positionWS = lights[0].positionWS;
    state.open->replaceLights("replace", 0, lights.size(), lights);
    state.showsMarkers = false;
    state.selectedLight = 1;
    state.selectedLights = {1, 2};
    std::vector<int> marked;
    for (const LightMarker& marker : lightMarkers(state, kArea)) marked.push_back(marker.light);
    EXPECT_EQ(marked, (std::vector<int>{1, 2}));
    EXPECT_EQ(otherFigures(state, kArea).size(), 1u);
    state.selectedLights.clear();
    EXPECT_TRUE(otherFigures(state, kArea).empty());
}

} // namespace
} // namespace tessera::viewer
