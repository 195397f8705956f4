#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {

void cameraPanel(State& state) {
    if (!state.open) return;
    OpenScene& open = *state.open;
    std::vector<Choice> choices;
    for (const scenes::Camera& camera : open.cameras()) choices.push_back({camera.name, ""});
    const auto now = std::size_t(open.camera());
    if (const auto chosen = choose("Camera", choices[now].name, choices, now)) {
        open.jumpToCamera(int(*chosen));
        state.active().settings.camera = int(*chosen);
    }
    CameraRig& rig = open.rig();
    row("Moves by");
    if (ImGui::RadioButton("orbit", rig.mode() == CameraRig::Mode::Orbit)) rig.setMode(CameraRig::Mode::Orbit);
    tip("Left drag turns, Alt and drag moves, wheel or Ctrl and drag goes nearer");
    ImGui::SameLine();
    if (ImGui::RadioButton("fly", rig.mode() == CameraRig::Mode::Fly)) rig.setMode(CameraRig::Mode::Fly);
    tip("W A S D and Q E, left drag looks around, Shift is fast, the wheel sets the speed");
    if (ImGui::Button("All in view (Shift+F)")) open.jumpToAll(state.pictureAspect);
    tip("Moves the camera until it sees all of the scene");
    ImGui::SameLine();
    if (ImGui::Button("Home")) open.jumpHome();
    tip("Back to the scene's camera");
    const CameraPose pose = rig.pose();
    const auto metres = [](double value) { return numberText("%.3f", value); };
    fact("Eye", fmt::format("{} {} {} m", metres(pose.eyeWS.x), metres(pose.eyeWS.y), metres(pose.eyeWS.z)));
    fact("Pivot at", metres(pose.focusMetres) + " m");
}

} // namespace tessera::viewer
