#pragma once
#include <cstddef>
#include <string>
#include <variant>

#include "scenes/RigLinks.h"
#include "viewer/edit/LightList.h"
#include "viewer/session/SeenEnvironment.h"
#include "viewer/session/ShownCamera.h"

/// What can be undone. An edit holds what the scene does not have now: before an edit is undone that is what was there
/// before, afterwards what it made. Undoing and redoing are the same exchange.
namespace tessera::viewer {

/// Of neighbouring lights: `others` come in the place of `count` lights from `first` on.
struct LightsEdit {
    std::size_t first = 0, count = 0;
    Lights others;
    scenes::LightLinks links = {}; ///< which of the lights clips move with them
};

struct MaterialEdit {
    std::size_t index = 0;
    scenes::Material other; ///< with numbers at rest that clips change
};

/// A parameter of the scene's hook.
struct HookEdit {
    std::size_t parameter = 0;
    float other = 0.0f;
};

struct EnvironmentEdit {
    Surrounding other;
};

/// How the environment lies and shines: its own numbers, which change only where a file takes the view's over
/// (OpenScene::becomes()), and how the view turns and brightens it.
struct EnvironmentViewEdit {
    scenes::EnvironmentView own, view;
};

struct CameraEdit {
    CameraView other;
};

/// Of all stored viewpoints.
struct ViewpointsEdit {
    std::vector<scenes::Camera> others;
};

using Edit =
    std::variant<LightsEdit, MaterialEdit, HookEdit, EnvironmentEdit, EnvironmentViewEdit, CameraEdit, ViewpointsEdit>;

/// Movements of the camera are no edits of the scene: nothing of it is lost with them.
inline bool changesScene(const Edit& edit) {
    return !std::holds_alternative<CameraEdit>(edit);
}

/// Whether two edits are of the same lights, material or parameter, of how the environment lies and shines, or of where
/// the camera is, so that one drag can make one of them.
bool areOfOneElement(const Edit& first, const Edit& second);

/// What was done to a light, a material or the environment, as the user is told: "move light 'lamp 3'". The label is
/// how lists call it.
std::string changeText(const scenes::Light& before, const scenes::Light& after, const std::string& label);
/// The same of several, of which this is one: "move 3 lights".
std::string changeText(const scenes::Light& before, const scenes::Light& after, std::size_t count);
std::string changeText(const scenes::Material& before, const scenes::Material& after, const std::string& label);
std::string changeText(const scenes::EnvironmentView& before, const scenes::EnvironmentView& after);

} // namespace tessera::viewer
