#include <cfloat>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/Keys.h"

namespace tessera::viewer {

namespace {

void axisRow(OpenScene& open, double aspect) {
    row("Look from");
    const auto views = float(axisViews().size());
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - (views - 1.0f) * spacing) / views;
    for (const AxisView& view : axisViews()) {
        if (&view != axisViews().data()) ImGui::SameLine();
        if (ImGui::Button(view.name, {width, 0.0f}))
            open.jumpToHeading(std::string("look ") + view.meaning, view.heading, aspect);
        tip(fmt::format("{} (Ctrl+{:c})", view.meaning, char(view.key)));
    }
}

void numberRows(OpenScene& open) {
    constexpr float kSpeedShare = 0.002f; // of the focus distance, per pixel of a drag
    constexpr float kLeastDegrees = 1.0f, kMostDegrees = 170.0f;
    const CameraPose pose = open.rig().pose();
    const float speed = kSpeedShare * float(pose.focusMetres);
    glm::dvec3 eyeWS = pose.eyeWS, targetWS = targetOf(pose);
    bool moved = dragVector("Eye", eyeWS, speed, kMostMetres);
    if (moved) open.moveCamera(between(pose, eyeWS, targetWS), widgetGesture());
    moved = dragVector("Target", targetWS, speed, kMostMetres);
    if (moved) open.moveCamera(between(pose, eyeWS, targetWS), widgetGesture());
    fact("Pivot at", numberText("%.3f", pose.focusMetres) + " m");
    if (open.rig().start().projection != scenes::Projection::Perspective) return;
    auto radians = float(open.rig().start().fovYRadians);
    if (angleSlider("Field of view", radians, kLeastDegrees, kMostDegrees)) {
        constexpr double kStepsADegree = 10.0; // precision of the display
        open.changeFieldOfView(std::round(kStepsADegree * glm::degrees(double(radians))) / kStepsADegree,
                               widgetGesture());
    }
}

/// The stored viewpoints, each with a button that removes it.
void viewpointRows(State& state) {
    OpenScene& open = *state.open;
    row("Viewpoints");
    if (ImGui::Button("Store this one", {-FLT_MIN, 0.0f})) open.storeViewpoint();
    tip("Keeps where the camera is. A saved scene has it as a camera.");
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < open.viewpoints().size(); ++i) {
        ImGui::PushID(int(i));
        row("");
        const float side = ImGui::GetFrameHeight();
        const float width = ImGui::GetContentRegionAvail().x - side - ImGui::GetStyle().ItemSpacing.x;
        if (ImGui::Button(labelOf(open.viewpoints()[i].name).c_str(), {width, 0.0f})) open.jumpToViewpoint(i);
        tip("Goes there");
        ImGui::SameLine();
        if (ImGui::Button("x", {side, 0.0f})) removed = i;
        tip("Removes it");
        ImGui::PopID();
    }
    if (removed) open.removeViewpoint(*removed);
}

} // namespace

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
    axisRow(open, state.pictureAspect);
    numberRows(open);
    viewpointRows(state);
}

} // namespace tessera::viewer
