#include "viewer/panels/InspectorBox.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr ImU32 kBoxInk = IM_COL32(220, 222, 228, 255), kBoxBehind = IM_COL32(20, 21, 24, 225);
constexpr float kTexelPoints = 8.0f, kBoxPad = 6.0f, kBesidePoints = 24.0f;

/// Start of a box beside a point: after it, or before it if there is no room after it; inside the image.
float besidePoint(float point, float size, float begin, float end, float beside) {
    const float behind = point + beside, before = point - beside - size;
    const float preferred = behind + size <= end || before < begin ? behind : before;
    return std::clamp(preferred, begin, std::max(begin, end - size));
}

void outline(ImDrawList& list, const glm::vec2& corner, float size, float width) {
    list.AddRect({corner.x, corner.y}, {corner.x + size, corner.y + size}, IM_COL32(20, 20, 24, 200), 0.0f, 0,
                 2.0f * width);
    list.AddRect({corner.x, corner.y}, {corner.x + size, corner.y + size}, kBoxInk, 0.0f, 0, width);
}

} // namespace

void drawInspector(State& state, const Facts& facts, const PictureArea& area) {
    const std::optional<glm::vec2> place = state.inspectedPlace();
    state.inspectorBox.reset();
    if (!place || !facts.inspection) return;
    const float pad = kBoxPad * area.scale, line = ImGui::GetTextLineHeight();
    const float texel = kTexelPoints * area.scale, loupe = float(kLoupeTexels) * texel;
    const std::vector<std::string> lines = inspectionLines(*facts.inspection);
    const int sides = facts.inspection->sides[1] ? 2 : 1;
    glm::vec2 size(float(sides) * (loupe + pad) - pad, loupe + pad + float(lines.size()) * line);
    for (const std::string& text : lines) size.x = std::max(size.x, ImGui::CalcTextSize(text.c_str()).x);
    size += 2.0f * pad;
    if (area.size.x < size.x || area.size.y < size.y) return;
    const glm::vec2 point = pointOf(state, area, *place), end = area.corner + area.size;
    const float beside = kBesidePoints * area.scale;
    const glm::vec2 corner(besidePoint(point.x, size.x, area.corner.x, end.x, beside),
                           besidePoint(point.y, size.y, area.corner.y, end.y, beside));
    state.inspectorBox = {corner, size};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({area.corner.x, area.corner.y}, {end.x, end.y});
    if (state.pinnedPlace) outline(list, point - 0.75f * texel, 1.5f * texel, area.scale);
    // The loupes are drawn below the interface, so the box leaves them free.
    const glm::vec2 first = corner + pad, words = first + glm::vec2(0.0f, loupe + pad);
    const float rounding = ImGui::GetStyle().FrameRounding;
    list.AddRectFilled({corner.x, corner.y}, {corner.x + size.x, first.y}, kBoxBehind, rounding,
                       ImDrawFlags_RoundCornersTop);
    list.AddRectFilled({corner.x, first.y + loupe}, {corner.x + size.x, corner.y + size.y}, kBoxBehind, rounding,
                       ImDrawFlags_RoundCornersBottom);
    float x = corner.x;
    for (int side = 0; side < sides; ++side) {
        const glm::vec2 at(first.x + float(side) * (loupe + pad), first.y);
        list.AddRectFilled({x, first.y}, {at.x, first.y + loupe}, kBoxBehind);
        x = at.x + loupe;
        state.loupes.push_back({side, at, loupe});
        outline(list, at + 0.5f * (loupe - texel), texel, area.scale);
    }
    list.AddRectFilled({x, first.y}, {corner.x + size.x, first.y + loupe}, kBoxBehind);
    for (std::size_t i = 0; i < lines.size(); ++i)
        list.AddText({words.x, words.y + float(i) * line}, kBoxInk, lines[i].c_str());
    list.PopClipRect();
}

void drawPins(State& state, const PictureArea& area) {
    if (state.pins.empty() || !state.inspects) return;
    const float side = kTexelPoints * area.scale;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::vec2 end = area.corner + area.size;
    list.PushClipRect({area.corner.x, area.corner.y}, {end.x, end.y});
    for (std::size_t i = 0; i < state.pins.size(); ++i) {
        const glm::vec2 point = pointOf(state, area, state.pins[i].place);
        outline(list, point - 0.5f * side, side, area.scale);
        list.AddText({point.x + side, point.y - side}, kBoxInk, fmt::format("{}", i + 1).c_str());
    }
    list.PopClipRect();
    const float margin = kBesidePoints * area.scale;
    // In the middle: titles of views are above, legends below.
    ImGui::SetNextWindowPos({end.x - margin, area.corner.y + 0.5f * area.size.y}, ImGuiCond_Appearing, {1.0f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {area.size.x, std::max(area.size.y - 2.0f * margin, margin)});
    std::optional<std::size_t> removed;
    if (ImGui::Begin("Pinned pixels", nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoCollapse)) {
        // A list that has grown stays within the image.
        const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
        ImGui::SetWindowPos({std::clamp(at.x, area.corner.x, std::max(area.corner.x, end.x - margin - size.x)),
                             std::clamp(at.y, area.corner.y, std::max(area.corner.y, end.y - margin - size.y))});
        for (std::size_t i = 0; i < state.pins.size(); ++i) {
            ImGui::PushID(int(i));
            ImGui::AlignTextToFramePadding();
            ImGui::Text("%zu", i + 1);
            ImGui::SameLine();
            if (ImGui::Button("Copy"))
                ImGui::SetClipboardText(fmt::format("{}", fmt::join(state.pins[i].lines, "\n")).c_str());
            tip("These lines, for another program");
            ImGui::SameLine();
            if (ImGui::Button("x")) removed = i;
            tip("Takes it away");
            for (const std::string& text : state.pins[i].lines) ImGui::TextUnformatted(text.c_str());
            ImGui::PopID();
        }
    }
    ImGui::End();
    if (removed) state.pins.erase(state.pins.begin() + std::ptrdiff_t(*removed));
}

} // namespace tessera::viewer
