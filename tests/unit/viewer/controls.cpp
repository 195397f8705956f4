#include "viewer/session/Controls.h"

#include <gtest/gtest.h>

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

TEST(Controls, shiftAndTheRightButtonTurnTheEnvironmentAndNothingWhereThereIsNone) {
    State state = withLightInTheMiddle(0, 1);
    const auto dragged = [&](int modifiers) {
        InputEvent press, move, release;
        press.kind = release.kind = InputEvent::Kind::Button;
        press.code = release.code = 1; // GLFW's right one
        press.modifiers = modifiers;
        press.down = true;
        press.position = {200.0, 200.0};
        move.kind = InputEvent::Kind::Move;
        move.position = release.position = {300.0, 200.0};
        const std::array events{press, move, release};
        Controls controls;
        controls.handle(events, state, kArea, {});
        return state.looks[0].settings.environment.rotationDegrees;
    };
    constexpr int kShift = 1; // GLFW's
    EXPECT_EQ(dragged(kShift), 0.0f);
    state.open->edit().environment.emplace();
    EXPECT_EQ(dragged(0), 0.0f);
    EXPECT_EQ(dragged(kShift), 45.0f); // a quarter of the picture's height
}

} // namespace
} // namespace tessera::viewer
