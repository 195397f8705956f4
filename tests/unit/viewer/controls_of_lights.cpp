// Selecting and dragging lights in the image.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/viewer/ControlledWindow.h"
#include "viewer/edit/LightList.h"
#include "viewer/session/Controls.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

using namespace test;

TEST(ControlsOfLights, aLightIsGrabbedByItsMarkerAndNeverWithoutOne) {
    State shown = withLightInTheMiddle(kMostMarkers - 1, kMostMarkers + 2);
    EXPECT_EQ(selectedByPress(shown), int(kMostMarkers) - 1);
    State beyond = withLightInTheMiddle(kMostMarkers, kMostMarkers + 2);
    EXPECT_EQ(selectedByPress(beyond), scenes::kNone);
    beyond.selectedLight = int(kMostMarkers); // a selected light is always marked
    EXPECT_EQ(selectedByPress(beyond), int(kMostMarkers));
    State hidden = withLightInTheMiddle(0, 1);
    hidden.showsMarkers = false;
    EXPECT_EQ(selectedByPress(hidden), scenes::kNone);
}

/// A window with a selected rectangle at the image's centre, 200 pixels wide and viewed edge-on.
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
    state.open = std::move(stateOf(std::move(scene)).open);
    return state;
}
constexpr glm::vec2 kRightSide{300.0f, 200.0f};

void press(Controls& controls, State& state, glm::vec2 position, bool down) {
    handle(controls, state, {button(position, down)});
}
void moveTo(Controls& controls, State& state, glm::vec2 position) {
    handle(controls, state, {test::moveTo(position)});
}

TEST(ControlsOfLights, aSideOfTheSelectedLightGoesWithThePointerAndWithShiftAlone) {
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
    handle(controls, state, {key(kShiftKey)});
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

TEST(ControlsOfLights, aHandleEndsWithItsLight) {
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

TEST(ControlsOfLights, oneDragOfAHandleIsOneStepThatIsUndoneWhenItIsOver) {
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

TEST(ControlsOfLights, aDragOfAnArmMovesItsLightAloneInOneStep) {
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

TEST(ControlsOfLights, handlesAreTakenAsFarBesideThemAsTheDisplayIsDense) {
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

TEST(ControlsOfLights, directionalLightsHaveSunsAtThePicturesSideWhereAllAreMarked) {
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
    Controls controls;
    press(controls, state, second, true);
    EXPECT_EQ(state.selectedLight, 2);
    state.showsMarkers = false;
    EXPECT_EQ(suns(), 0);
}

TEST(ControlsOfLights, allSelectedLightsAreMarkedAndHaveOutlines) {
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
