#pragma once
#include <cstddef>
#include <initializer_list>
#include <span>

#include "tests/unit/viewer/Scenes.h"
#include "viewer/session/Controls.h"

/// A window with an image of 400 x 400 pixels, and its input.
namespace tessera::viewer::test {

inline constexpr PictureArea kArea{{0.0f, 0.0f}, {400.0f, 400.0f}};

// GLFW's modifiers, buttons and keys.
inline constexpr int kShift = 1, kControl = 2;
inline constexpr int kLeftButton = 0, kRightButton = 1, kMiddleButton = 2;
inline constexpr int kEscapeKey = 256, kEnterKey = 257, kShiftKey = 340, kControlKey = 341;

inline InputEvent button(const glm::vec2& position, bool down, int code = kLeftButton, int modifiers = 0) {
    return {.kind = InputEvent::Kind::Button, .code = code, .down = down, .modifiers = modifiers, .position = position};
}
inline InputEvent moveTo(const glm::vec2& position) {
    return {.kind = InputEvent::Kind::Move, .position = position};
}
inline InputEvent scroll(const glm::vec2& position, float steps, int modifiers = 0) {
    return {.kind = InputEvent::Kind::Scroll,
            .modifiers = modifiers,
            .position = position,
            .scroll = glm::vec2(0.0f, steps)};
}
/// `letter` is the key's letter in the keyboard layout.
inline InputEvent key(int code, int modifiers = 0, int letter = 0) {
    return {.kind = InputEvent::Kind::Key, .code = code, .down = true, .modifiers = modifiers, .letter = letter};
}

inline void handle(Controls& controls, State& state, std::initializer_list<InputEvent> events,
                   const Controls::Claims& claims = {}, const PictureArea& area = kArea) {
    controls.handle(std::span(events.begin(), events.size()), state, area, claims);
}

/// A window whose scene has a light at the image's centre and others out of view.
inline State withLightInTheMiddle(std::size_t index, std::size_t count) {
    scenes::Scene scene = roomWith(std::vector<scenes::Light>(count));
    const glm::dmat4& worldFromCamera = scene.cameras.front().worldFromCamera;
    for (scenes::Light& light : scene.lights) light.positionWS = worldFromCamera * glm::dvec4(0, 0, 5, 1);
    scene.lights[index].positionWS = worldFromCamera * glm::dvec4(0, 0, -1, 1);
    State state = stateOf(std::move(scene));
    state.showsMarkers = true;
    return state;
}

/// Returns the selected light after a press at the image's centre.
inline int selectedByPress(State& state) {
    Controls controls;
    handle(controls, state, {button({200.0f, 200.0f}, true)});
    return state.selectedLight;
}

} // namespace tessera::viewer::test
