#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "viewer/session/Controls.h"

/// A window whose picture is 400 x 400, for what the pointer does in it.
namespace tessera::viewer::test {

inline constexpr PictureArea kArea{{0.0f, 0.0f}, {400.0f, 400.0f}};

/// A window whose scene has a light in the picture's middle and others out of view.
inline State withLightInTheMiddle(std::size_t index, std::size_t count) {
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
inline int selectedByPress(State& state) {
    InputEvent press;
    press.kind = InputEvent::Kind::Button;
    press.code = 0; // GLFW's left one
    press.down = true;
    press.position = {200.0, 200.0};
    Controls controls;
    controls.handle(std::span(&press, 1), state, kArea, {});
    return state.selectedLight;
}

} // namespace tessera::viewer::test
