#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/viewer/CameraTest.h"
#include "viewer/session/State.h"

/// Open scenes, and edits of them.
namespace tessera::viewer::test {

/// A window that shows a scene, loaded from `source`.
inline State stateOf(scenes::Scene scene, const scenes::LoadOptions& load = {}, std::string source = "room") {
    State state;
    state.open = std::make_unique<OpenScene>(std::move(source), load, std::move(scene), scenes::SceneOrigin());
    return state;
}

/// The built-in room with these lights in place of its own.
inline scenes::Scene roomWith(std::vector<scenes::Light> lights) {
    scenes::Scene scene = scenes::loadScene("room");
    scene.lights = std::move(lights);
    return scene;
}

/// A window that shows the built-in room with one light of this type, which is selected.
inline State roomWithLight(scenes::LightType type = scenes::LightType::Point) {
    scenes::Light light;
    light.type = type;
    State state = stateOf(roomWith({light}));
    state.selectedLight = 0;
    return state;
}

/// A scene as a window opens it, with the origin that saving needs.
inline std::unique_ptr<OpenScene> opened(const std::string& source) {
    scenes::Scene scene = scenes::loadScene(source);
    scenes::SceneOrigin origin = scenes::originOf(source, {}, scene);
    return std::make_unique<OpenScene>(source, scenes::LoadOptions(), std::move(scene), std::move(origin));
}

/// Changes a light of an open scene, as an edit.
template <typename Change>
void changeLight(OpenScene& open, std::size_t index, const Change& change, Gesture gesture = Gesture::Once) {
    scenes::Light light = open.scene().lights.at(index);
    change(light);
    open.changeLight(index, std::move(light), gesture);
}
template <typename Change>
void changeLight(State& state, std::size_t index, const Change& change) {
    changeLight(*state.open, index, change);
}
template <typename Change>
void changeMaterial(OpenScene& open, std::size_t index, const Change& change) {
    scenes::Material material = open.scene().materials.at(index);
    change(material);
    open.changeMaterial(index, std::move(material));
}
inline void setIntensity(OpenScene& open, float intensity) {
    changeLight(open, 0, [&](scenes::Light& light) { light.intensity = intensity; });
}

/// Advances until the camera is static.
inline void settle(OpenScene& open) {
    open.rig().advance(kLongSeconds, kHeightPixels);
    open.applyRig();
}
/// Rotates the camera by hand.
inline void turnCamera(OpenScene& open) {
    open.rig().rotate({120.0, 30.0}, kHeightPixels);
    settle(open);
}

} // namespace tessera::viewer::test
