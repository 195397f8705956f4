#include <cfloat>

#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {

void savePanel(State& state) {
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("PNG (F12)", {half, 0.0f})) state.requests.savePng = true;
    tip("The picture as a display shows it");
    ImGui::SameLine();
    if (ImGui::Button("EXR (Shift+F12)", {half, 0.0f})) state.requests.saveExr = true;
    tip("Linear radiance, 32 bits a channel");
    if (ImGui::Button("Scene (Ctrl+S)", {half, 0.0f})) state.requests.saveScene = true;
    tip("A .json that loads back with every edit");
    ImGui::SameLine();
    if (ImGui::Button("Copy command", {half, 0.0f})) state.requests.copyCommand = true;
    tip("The command line that renders this picture (Ctrl+C)");
    if (ImGui::Button("Trace", {half, 0.0f})) state.requests.saveTrace = true;
    tip("Times of the latest frames' passes, for chrome://tracing or Perfetto");
    ImGui::SameLine();
    ImGui::BeginDisabled(!state.open || !state.open->isEdited());
    if (ImGui::Button("Revert", {half, 0.0f})) revert(state);
    ImGui::EndDisabled();
    tip("Back to the scene as it was opened or saved last");
    if (ImGui::Button("Save as ... (Ctrl+Shift+S)", {-FLT_MIN, 0.0f})) state.requests.showSaveDialog = true;
    tip("The scene or the picture, in a folder and under a name of your choice");
    ImGui::SetNextItemWidth(-FLT_MIN);
    std::string& command = state.command;
    if (!command.empty())
        ImGui::InputText("##command", command.data(), command.size() + 1, ImGuiInputTextFlags_ReadOnly);
    paragraph("The other buttons write into the folder the program was started in, under the first free number.");
}

} // namespace tessera::viewer
