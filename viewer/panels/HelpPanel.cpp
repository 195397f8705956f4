#include <algorithm>
#include <vector>

#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/session/Keys.h"

namespace tessera::viewer {
namespace {

struct HelpRow {
    const char* name;
    const char* meaning;
};
struct HelpGroup {
    const char* heading;
    std::vector<HelpRow> rows;
};

std::vector<HelpGroup> helpGroups() {
    std::vector<HelpGroup> groups{{"Mouse and held keys", {}}};
    for (const GestureHelp& gesture : gestureHelp()) groups.back().rows.push_back({gesture.name, gesture.meaning});
    for (const KeyBinding& binding : keyBindings()) {
        if (binding.group != nullptr) groups.push_back({binding.group, {}});
        if (*binding.name != '\0') groups.back().rows.push_back({binding.name, binding.meaning});
    }
    return groups;
}

void helpTable(const HelpGroup& group) {
    ImGui::TextDisabled("%s", group.heading);
    if (!ImGui::BeginTable(group.heading, 2)) return;
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 9.5f * ImGui::GetFontSize());
    ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthStretch);
    for (const HelpRow& row : group.rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(row.name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.meaning);
        ImGui::PopTextWrapPos();
    }
    ImGui::EndTable();
    ImGui::Spacing();
}

} // namespace

void helpOverlay(State& state, float scale) {
    constexpr float kColumnWidth = 390.0f;
    constexpr int kMostColumns = 3;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const int columns = std::clamp(int(display.x / (kColumnWidth * scale)), 1, kMostColumns);
    const float width = std::min(float(columns) * kColumnWidth * scale, display.x);
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, display.y});
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("Help", &state.showsHelp, flags) &&
        ImGui::BeginTable("groups", columns, ImGuiTableFlags_SizingStretchSame)) {
        const std::vector<HelpGroup> groups = helpGroups();
        std::size_t rows = 0, all = 0;
        for (const HelpGroup& group : groups) all += group.rows.size();
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        std::size_t column = 0;
        for (const HelpGroup& group : groups) {
            if (rows * std::size_t(columns) >= (column + 1) * all) {
                ImGui::TableNextColumn();
                ++column;
            }
            helpTable(group);
            rows += group.rows.size();
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace tessera::viewer
