#include "viewer/panels/Frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "viewer/panels/Handles.h"
#include "viewer/panels/InspectorBox.h"
#include "viewer/panels/Legend.h"
#include "viewer/panels/Markers.h"
#include "viewer/panels/Overlays.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/ResourceBox.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/Playback.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr float kStatusHeight = 22.0f;
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoFocusOnAppearing; // which would interrupt a drag

float panelWidth(const State& state, float scale) {
    return state.showsPanel ? state.panelWidth * scale : 0.0f;
}

/// A section of the panels.
struct Section {
    const char* title;
    bool isOpen; ///< initially
    void (*show)(State&, const Facts&);
    std::optional<Selected> selected = {}; ///< selection that scrolls it into view
    bool (*isThere)(const State&) = [](const State& state) { return state.open != nullptr; };
};

bool hasMovement(const State& state) {
    return state.open && (canMove(state) || !state.open->scene().rig.clips.empty());
}

/// From the top: the scene's contents, how it is viewed, then details of techniques. Most sections need an open scene,
/// which determines the initial settings.
constexpr Section kSections[] = {
    {"Scene", true, scenePanel, {}, [](const State&) { return true; }},
    {"Lights", false, [](State& state, const Facts&) { lightsPanel(state); }, Selected::Light},
    {"Materials", false, [](State& state, const Facts&) { materialsPanel(state); }, Selected::Material},
    {"View", true, [](State& state, const Facts&) { viewPanel(state); }},
    {"Environment", false, environmentPanel},
    {"Camera", false, [](State& state, const Facts&) { cameraPanel(state); }},
    {"Animation", true, [](State& state, const Facts&) { animationPanel(state); }, {}, hasMovement},
    {"Save", false, [](State& state, const Facts&) { savePanel(state); }},
    {"Technique", false, [](State& state, const Facts&) { framePanel(state); }},
    {"Shadows", false, shadowsPanel},
    {"Subsurface scattering", false, [](State& state, const Facts&) { skinPanel(state); }},
    {"Compare", false, comparePanel},
    {"Timings", false, timingsPanel},
    {"Light culling", false, cullingPanel},
    {"Graph", false, graphPanel},
};

void showSection(State& state, const Facts& facts, const Section& section) {
    const auto known = state.sections.find(section.title);
    const bool wasOpen = known != state.sections.end() ? known->second : section.isOpen;
    const bool isRevealed = section.selected && state.reveals == section.selected;
    ImGui::SetNextItemOpen(wasOpen || isRevealed);
    // Borders mark widgets for input, and the selection colour is for rows of lists.
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_Tab));
    ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImGui::GetStyleColorVec4(ImGuiCol_TabHovered));
    ImGui::PushStyleColor(ImGuiCol_HeaderActive, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
    const float topY = ImGui::GetCursorPosY();
    const bool isOpen = ImGui::CollapsingHeader(section.title);
    ImGui::PopStyleColor(3);
    ImGui::PopStyleVar();
    if (isRevealed) {
        state.reveals.reset();
        if (!wasOpen || !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.0f);
    }
    const bool isChanged = isOpen != wasOpen;
    if (isChanged) state.sections[section.title] = isOpen;
    if (!isOpen) return;
    ImGui::PushID(section.title);
    section.show(state, facts);
    ImGui::PopID();
    ImGui::Spacing();
    // Scrolls an opened section into view, at least its title.
    const float endY = ImGui::GetCursorPosY(), heightY = ImGui::GetWindowHeight();
    if (isChanged && !isRevealed && endY - ImGui::GetScrollY() > heightY)
        endY - topY < heightY ? ImGui::SetScrollFromPosY(endY - ImGui::GetScrollY(), 1.0f)
                              : ImGui::SetScrollFromPosY(topY - ImGui::GetScrollY(), 0.0f);
}

void foldAll(State& state) {
    for (const Section& section : kSections) state.sections[section.title] = false;
}

void sidePanel(State& state, const Facts& facts, float height, float scale) {
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({panelWidth(state, scale), height});
    if (std::exchange(state.foldsPanels, false)) foldAll(state);
    if (ImGui::Begin("Panels", nullptr, kFixed)) {
        for (const Section& section : kSections)
            if (section.isThere(state)) showSection(state, facts, section);
        if (ImGui::SmallButton("Fold all")) foldAll(state);
        tip("Every panel but its title (Shift+Tab)");
    }
    ImGui::End();
}

/// Highlights the panels' edge where it can be dragged.
void drawPanelEdge(const State& state, const PictureArea& area, float scale) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool isPointed =
        !io.WantCaptureMouse && !ImGui::IsAnyMouseDown() && isAtPanelEdge(state, area, {io.MousePos.x, io.MousePos.y});
    if (!isPointed && !state.isPanelEdgeHeld) return;
    const float x = area.corner.x + 0.5f * scale;
    ImGui::GetBackgroundDrawList()->AddLine({x, area.corner.y}, {x, area.corner.y + area.size.y},
                                            ImGui::GetColorU32(ImGuiCol_CheckMark), 2.0f * scale);
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

/// Parts of the status line, the most important first.
std::vector<std::string> statusParts(const State& state, const Facts& facts) {
    std::vector<std::string> parts;
    if (!state.loading.empty())
        parts.emplace_back("loading ...");
    else if (facts.diffusion)
        parts.push_back(diffusionText(*facts.diffusion));
    if (state.magnification.isOn())
        parts.push_back(fmt::format("pixels x {} (Ctrl+0: all)", state.magnification.times));
    if (facts.isCancelled) parts.emplace_back("cancelled (Enter: draw on)");
    if (state.open && state.open->rig().mode() == CameraRig::Mode::Fly)
        parts.push_back(fmt::format("flying, {:.3g} m/s (C: orbit)", state.open->rig().flyMetresPerSecond()));
    // The sides of a comparison are named in the image; two names would not fit here.
    const std::optional<Look>& left = facts.shown[0];
    if (state.compare == Compare::Off && left)
        parts.push_back(lookName(*left, state.open ? &state.open->scene().lights : nullptr));
    if (facts.scale > 0.0) {
        double ms = 0.0; // of the displayed sides
        for (int side = 0; side < state.sides(); ++side)
            if (const FrameTimes* const latest = state.timings.latest(side)) ms += latest->ms;
        parts.push_back(pictureTimeText(ms));
        if (facts.picturesPerSecond) parts.push_back(fmt::format("{:.0f} frames/s", *facts.picturesPerSecond));
        parts.push_back(fmt::format("scale {:.3g}", facts.scale));
        parts.push_back(fmt::format("{}x{}", facts.sizePixels.x, facts.sizePixels.y));
    }
    return parts;
}

/// A small button that undoes or redoes; its tooltip describes the edit.
void historyButton(const char* label, const char* keys, const std::string* what, State& state, void (*act)(State&)) {
    const std::string meaning = what != nullptr ? fmt::format("{}: {} ({})", label, *what, keys) : "";
    ImGui::BeginDisabled(what == nullptr);
    const bool isPressed = ImGui::SmallButton(label);
    ImGui::EndDisabled();
    tip(meaning);
    if (isPressed) act(state);
}

void historyButtons(State& state) {
    if (!state.open) return;
    historyButton("Undo", "Ctrl+Z", state.open->history().undoText(), state, undo);
    ImGui::SameLine();
    historyButton("Redo", "Ctrl+Y", state.open->history().redoText(), state, redo);
    ImGui::SameLine();
}

void statusLine(State& state, const Facts& facts, const PictureArea& area, float scale) {
    ImGui::SetNextWindowPos({area.corner.x, area.corner.y + area.size.y});
    ImGui::SetNextWindowSize({area.size.x, kStatusHeight * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(8.0f * scale, 4.0f * scale));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
    if (ImGui::Begin("Status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar)) {
        historyButtons(state);
        const float textX = ImGui::GetCursorPosX();
        std::vector<std::string> parts = statusParts(state, facts);
        const char* hint = "F1 help";
        const float hintX = area.size.x - ImGui::CalcTextSize(hint).x - 8.0f * scale;
        std::string text;
        const auto fits = [&] {
            text = fmt::format("{}", fmt::join(parts, "   "));
            return textX + ImGui::CalcTextSize(text.c_str()).x + 16.0f * scale < hintX;
        };
        while (!fits() && parts.size() > 1) parts.pop_back();
        ImGui::TextUnformatted(text.c_str());
        if (fits()) {
            ImGui::SameLine(hintX);
            ImGui::TextDisabled("%s", hint);
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

/// A shader error, and the folded list of its programs, which have up to some sixty defines each.
void faultRows(const ShownFault& fault) {
    errorParagraph(fault.text);
    if (fault.programs.empty()) return;
    const std::size_t count = fault.programs.size();
    ImGui::PushID(fault.text.c_str());
    if (ImGui::TreeNode("programs", "in %zu program%s", count, count == 1 ? "" : "s")) {
        for (const std::string& program : fault.programs) paragraph(program);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

/// Errors and messages at the image's lower edge.
void notices(State& state, const PictureArea& area, float scale) {
    if (state.notice.text.empty() && state.shaderFaults.empty()) return;
    const float margin = 12.0f * scale;
    const float width = area.size.x - 2.0f * margin;
    if (width < 100.0f * scale) return;
    ImGui::SetNextWindowPos({area.corner.x + margin, area.corner.y + area.size.y - margin}, ImGuiCond_Always,
                            {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, std::max(0.5f * area.size.y, 40.0f * scale)});
    ImGui::SetNextWindowBgAlpha(0.92f);
    if (ImGui::Begin("Notice", nullptr,
                     (kFixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_AlwaysAutoResize)) {
        for (const ShownFault& fault : state.shaderFaults) faultRows(fault);
        if (state.notice.isError) {
            errorParagraph(state.notice.text);
        } else if (!state.notice.text.empty()) {
            paragraph(state.notice.text);
            // Errors stay until Esc: a click may be accidental.
            if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) state.notice = {};
        }
    }
    ImGui::End();
}

} // namespace

PictureArea pictureArea(const State& state, glm::vec2 windowSize, float scale) {
    PictureArea area;
    area.scale = scale;
    area.corner = {panelWidth(state, scale), 0.0f};
    area.size = glm::max(windowSize - area.corner - glm::vec2(0.0f, kStatusHeight * scale), glm::vec2(0.0f));
    if (area.size.x < 1.0f || area.size.y < 1.0f) area.size = glm::vec2(0.0f);
    return area;
}

glm::ivec2 windowSizeFor(glm::ivec2 pictureSize, float panelWidth) {
    return pictureSize + glm::ivec2(panelWidth, kStatusHeight);
}

std::string pictureTimeText(double ms) {
    constexpr double kLongMs = 10'000.0;
    return std::round(ms) < kLongMs ? fmt::format("{:.0f} ms", ms) : fmt::format("{:.0f} s", ms / 1000.0);
}

void drawInterface(State& state, const Facts& facts, const PictureArea& area, float scale) {
    const float height = ImGui::GetIO().DisplaySize.y;
    state.loupes.clear();
    state.wantsPlan = state.wantsThumbnails = state.showsMaterial = false; // set again by panels that are visible
    if (state.showsPanel) sidePanel(state, facts, height, scale);
    if (area.size.x > 0.0f) {
        statusLine(state, facts, area, scale);
        drawMaterialOutline(state, facts, area);
        drawMarkers(state, area, scale);
        drawHandles(state, area);
        drawDivider(state, area, scale); // above handles, because it is grabbed first
        drawLegend(state, facts, area, scale);
        drawNames(state, facts, area, scale);
        drawPins(state, area); // below the inspector
        drawInspector(state, facts, area);
        drawResource(state, facts, area);
        drawDragText(state, area);
        drawPanelEdge(state, area, scale);
        if (facts.shownProgress())
            drawProgress(*facts.shownProgress(), area, state.inspectorBox, scale, *ImGui::GetBackgroundDrawList());
        notices(state, area, scale);
    }
    if (state.showsHelp) helpOverlay(state, scale);
    fileDialog(state, scale);
    questionDialog(state, scale);
    // Nothing is being dragged: the next edit is a separate step.
    if (state.open && !state.isDragging && !ImGui::IsAnyItemActive()) state.open->endGesture();
}

bool isDimming() {
    return ImGui::GetTopMostPopupModal() != nullptr && ImGui::GetCurrentContext()->DimBgRatio < 1.0f;
}

} // namespace tessera::viewer
