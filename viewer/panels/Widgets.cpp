#include "viewer/panels/Widgets.h"

#include <cfloat>

#include <imgui.h>

namespace tessera::viewer {
namespace {

/// Of a panel's width.
constexpr float kLabelShare = 0.36f;
constexpr float kTipWidthEm = 26.0f;

void text(std::string_view words) {
    ImGui::TextUnformatted(words.data(), words.data() + words.size());
}

} // namespace

void row(const char* label) {
    ImGui::AlignTextToFramePadding();
    text(label);
    ImGui::SameLine(ImGui::GetCursorStartPos().x + kLabelShare * ImGui::GetWindowContentRegionMax().x);
    ImGui::SetNextItemWidth(-FLT_MIN);
}

std::optional<std::size_t> choose(const char* label, std::string_view shown, std::span<const Choice> choices,
                                  std::size_t chosen) {
    std::optional<std::size_t> result;
    row(label);
    const std::string id = std::string("##") + label;
    if (!ImGui::BeginCombo(id.c_str(), std::string(shown).c_str(), ImGuiComboFlags_HeightLargest)) return result;
    closeOnEscape();
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const ImGuiSelectableFlags flags = choices[i].isPossible ? 0 : ImGuiSelectableFlags_Disabled;
        ImGui::PushID(int(i)); // names may be equal
        if (ImGui::Selectable(std::string(choices[i].name).c_str(), i == chosen, flags)) result = i;
        if (i == chosen) ImGui::SetItemDefaultFocus();
        tip(choices[i].meaning);
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return result;
}

void closeOnEscape() {
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
}

void paragraph(std::string_view words) {
    ImGui::PushTextWrapPos(0.0f);
    text(words);
    ImGui::PopTextWrapPos();
}

void errorParagraph(std::string_view words) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
    paragraph(words);
    ImGui::PopStyleColor();
}

void tip(std::string_view words) {
    if (words.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * kTipWidthEm);
    text(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void fact(const char* label, const std::string& value) {
    row(label);
    paragraph(value);
}

} // namespace tessera::viewer
