#include <algorithm>

#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/session/Keys.h"

namespace tessera::viewer {
namespace {

void helpRow(const char* name, const char* meaning) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(meaning);
    ImGui::PopTextWrapPos();
}

void helpHeading(const char* words) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", words);
}

} // namespace

void helpOverlay(State& state, float scale) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const float width = std::min(620.0f * scale, display.x);
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, display.y});
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("Help", &state.showsHelp, flags) && ImGui::BeginTable("keys", 2)) {
        ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthStretch);
        helpHeading("Mouse and held keys");
        for (const GestureHelp& gesture : gestureHelp()) helpRow(gesture.name, gesture.meaning);
        helpHeading("Keys");
        for (const KeyBinding& binding : keyBindings())
            if (*binding.name != '\0') helpRow(binding.name, binding.meaning);
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace tessera::viewer
