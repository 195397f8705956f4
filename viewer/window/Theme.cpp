#include "viewer/window/Theme.h"

#include <imgui.h>

namespace tessera::viewer {
namespace {

ImVec4 grey(float level, float alpha = 1.0f) {
    // A trace of blue keeps large dark areas from looking brown beside images lit by warm lamps.
    return {level, level * 1.02f, level * 1.08f, alpha};
}

ImVec4 accent(float level, float alpha = 1.0f) {
    return {0.27f * level, 0.55f * level, 0.86f * level, alpha};
}

void applyColors(ImVec4* colors) {
    colors[ImGuiCol_Text] = grey(0.86f);
    colors[ImGuiCol_TextDisabled] = grey(0.52f);
    colors[ImGuiCol_WindowBg] = grey(0.115f);
    colors[ImGuiCol_ChildBg] = grey(0.0f, 0.0f);
    colors[ImGuiCol_PopupBg] = grey(0.12f);
    colors[ImGuiCol_ModalWindowDimBg] = grey(0.0f, 0.55f);
    // Around fields, whose background is too dark to stand out from a panel's.
    colors[ImGuiCol_Border] = grey(0.41f);
    // Darker than a panel, so that a slider's grab stands out from them, and numbers are readable on both.
    colors[ImGuiCol_FrameBg] = grey(0.05f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.075f);
    colors[ImGuiCol_FrameBgActive] = grey(0.09f);
    colors[ImGuiCol_TitleBg] = grey(0.09f);
    colors[ImGuiCol_TitleBgActive] = grey(0.13f);
    colors[ImGuiCol_ScrollbarBg] = grey(0.1f, 0.6f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.41f);
    colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.48f);
    colors[ImGuiCol_ScrollbarGrabActive] = grey(0.56f);
    colors[ImGuiCol_CheckMark] = accent(1.2f);
    // Drawn below the number (slideNumber()).
    colors[ImGuiCol_SliderGrab] = grey(0.75f);
    colors[ImGuiCol_SliderGrabActive] = grey(0.95f);
    colors[ImGuiCol_Button] = grey(0.25f);
    colors[ImGuiCol_ButtonHovered] = grey(0.32f);
    colors[ImGuiCol_ButtonActive] = accent(0.8f);
    colors[ImGuiCol_Header] = accent(0.68f);
    colors[ImGuiCol_HeaderHovered] = accent(0.72f);
    colors[ImGuiCol_HeaderActive] = accent(0.76f);
    // Section titles, which Dear ImGui would draw like rows of lists.
    colors[ImGuiCol_Tab] = grey(0.2f);
    colors[ImGuiCol_TabHovered] = grey(0.26f);
    colors[ImGuiCol_TabActive] = grey(0.3f);
    colors[ImGuiCol_Separator] = grey(0.24f);
    colors[ImGuiCol_PlotLines] = accent(1.1f);
    colors[ImGuiCol_PlotHistogram] = accent(0.95f);
    colors[ImGuiCol_TextSelectedBg] = accent(0.7f, 0.6f);
    colors[ImGuiCol_NavHighlight] = accent(1.0f);
    colors[ImGuiCol_TableHeaderBg] = grey(0.17f);
    colors[ImGuiCol_TableRowBgAlt] = grey(1.0f, 0.025f);
}

} // namespace

void applyTheme(float scale) {
    ImGuiStyle style;
    style.WindowRounding = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 3.0f;
    style.ScrollbarRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameBorderSize = 1.0f;
    style.WindowPadding = {8.0f, 8.0f};
    style.FramePadding = {6.0f, 3.0f};
    style.ItemSpacing = {6.0f, 5.0f};
    style.IndentSpacing = 12.0f;
    style.ScrollbarSize = 11.0f;
    applyColors(style.Colors);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

} // namespace tessera::viewer
