#pragma once
#include <cstddef>
#include <string>
#include <variant>

#include "scenes/RigLinks.h"
#include "viewer/edit/LightList.h"
#include "viewer/session/SeenEnvironment.h"
#include "viewer/session/ShownCamera.h"

/// Undoable edits. An edit holds the values that the scene does not have: the previous ones until it is undone, then
/// the edited ones. Undo and redo are the same exchange.
namespace tessera::viewer {

/// Replaces `count` neighbouring lights from `first` on by `others`.
struct LightsEdit {
    std::size_t first = 0, count = 0;
    Lights others;
    scenes::LightLinks links = {}; ///< which of the lights clips animate, exchanged with them
};

struct MaterialEdit {
    std::size_t index = 0;
    scenes::Material other; ///< animated numbers have their rest values
};

/// A parameter of the scene's hook.
struct HookEdit {
    std::size_t parameter = 0;
    float other = 0.0f;
};

struct EnvironmentEdit {
    Surrounding other;
};

/// Rotation and intensity of the environment: its own, which change only when a saved file adopts the view's
/// (OpenScene::becomes()), and those that the view applies to it.
struct EnvironmentViewEdit {
    scenes::EnvironmentView own, view;
};

struct CameraEdit {
    CameraView other;
};

/// All stored viewpoints.
struct ViewpointsEdit {
    std::vector<scenes::Camera> others;
};

using Edit =
    std::variant<LightsEdit, MaterialEdit, HookEdit, EnvironmentEdit, EnvironmentViewEdit, CameraEdit, ViewpointsEdit>;

/// Camera movements are not edits of the scene: no work is lost with them.
inline bool changesScene(const Edit& edit) {
    return !std::holds_alternative<CameraEdit>(edit);
}

/// Whether two edits change the same lights, material, parameter, environment view or camera, so that one drag can
/// merge them.
bool areOfOneElement(const Edit& first, const Edit& second);

/// Describes a change of a light, a material or the environment for the user: "move light 'lamp 3'". `label` is its
/// name in lists.
std::string changeText(const scenes::Light& before, const scenes::Light& after, const std::string& label);
/// The same for several lights, one of which is given: "move 3 lights".
std::string changeText(const scenes::Light& before, const scenes::Light& after, std::size_t count);
std::string changeText(const scenes::Material& before, const scenes::Material& after, const std::string& label);
std::string changeText(const scenes::EnvironmentView& before, const scenes::EnvironmentView& after);

} // namespace tessera::viewer
