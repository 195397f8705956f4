#include "viewer/panels/Legend.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <imgui.h>

#include "renderer/frame/DebugViews.h"
#include "shaders/shared/heat.h"
#include "validation/pictures/ShownPicture.h"
#include "viewer/edit/LightList.h"
#include "viewer/session/DrawnLook.h"

namespace tessera::viewer {
namespace {

constexpr ImU32 kBehind = IM_COL32(20, 21, 24, 215), kInk = IM_COL32(220, 222, 228, 255);

ImU32 colorAt(float position) {
    const glm::vec3 code = 255.0f * shared::heatColor(position) + 0.5f;
    return IM_COL32(int(code.r), int(code.g), int(code.b), 255);
}

const char* titleOf(frame::DebugView view) {
    return view == frame::DebugView::Overdraw ? "Surfaces a pixel shades" : "Lights a pixel visits";
}

/// A titled bar of heat colours, up to the largest count if it is known, else to the end of the colour scale.
void drawBar(const PictureArea& area, frame::DebugView view, std::optional<float> most, float log2Colours,
             float scale) {
    constexpr int kSteps = 48;
    const float log2Most = most ? std::log2(1.0f + std::max(*most, 1.0f)) : log2Colours;
    const char* const title = titleOf(view);
    const float pad = 8.0f * scale, line = ImGui::GetFontSize(), barWidth = 14.0f * scale;
    const float height = std::min(14.0f * line, area.size.y - 5.0f * pad - 2.0f * line);
    const float titleWidth = ImGui::CalcTextSize(title).x;
    if (height < 8.0f * line || area.size.x < titleWidth + 5.0f * pad) return; // too small to read
    const ImVec2 end(area.corner.x + area.size.x - 2.0f * pad, area.corner.y + area.size.y - 2.0f * pad);
    const float barX = end.x - barWidth, top = end.y - height, titleY = top - pad - 1.5f * line;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({end.x - titleWidth - pad, titleY - 0.5f * pad}, {end.x + pad, end.y + pad}, kBehind,
                       ImGui::GetStyle().FrameRounding);
    list.AddText({end.x - titleWidth, titleY}, kInk, title);
    const auto yAt = [&](float position) { return end.y - position * height; };
    for (int step = 0; step < kSteps; ++step) {
        const float from = float(step) / kSteps, to = float(step + 1) / kSteps;
        list.AddRectFilled({barX, yAt(to)}, {end.x, yAt(from)}, colorAt(0.5f * (from + to) * log2Most / log2Colours));
    }
    const auto label = [&](float count) {
        const std::string text = std::to_string(int(count));
        const float y = yAt(std::min(shared::heatPositionOfCount(count, log2Most), 1.0f));
        const float x = barX - 0.75f * pad - ImGui::CalcTextSize(text.c_str()).x;
        list.AddText({x, y - 0.5f * line}, kInk, text.c_str());
        list.AddLine({barX - 0.5f * pad, y}, {barX, y}, kInk);
    };
    // Labels keep clear of one another, and of the largest count's label if it has one.
    const float apart = line / height;
    const float endOfSteps = most ? 1.0f - apart : 1.0f;
    label(0.0f);
    for (float count = 1.0f; shared::heatPositionOfCount(count, log2Most) < endOfSteps; count *= 2.0f) label(count);
    if (most && *most >= 1.0f) label(*most);
}

/// Colours with their meanings, one below the other.
void drawSwatches(const PictureArea& area, std::span<const validation::Swatch> swatches, float scale) {
    const float pad = 8.0f * scale, line = ImGui::GetTextLineHeightWithSpacing(), side = ImGui::GetFontSize();
    float width = 0.0f;
    for (const validation::Swatch& swatch : swatches)
        width = std::max(width, ImGui::CalcTextSize(swatch.meaning.c_str()).x);
    const ImVec2 size(width + side + 3.0f * pad, float(swatches.size()) * line + 1.5f * pad);
    if (area.size.x < size.x + 2.0f * pad || area.size.y < size.y + 2.0f * pad) return; // too small to read
    const ImVec2 end(area.corner.x + area.size.x - pad, area.corner.y + area.size.y - pad);
    const ImVec2 corner(end.x - size.x, end.y - size.y);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(corner, end, kBehind, ImGui::GetStyle().FrameRounding);
    float y = corner.y + pad;
    for (const validation::Swatch& swatch : swatches) {
        const float x = corner.x + pad;
        list.AddRectFilled({x, y}, {x + side, y + side},
                           IM_COL32(swatch.colour.r, swatch.colour.g, swatch.colour.b, 255));
        list.AddText({x + side + pad, y}, kInk, swatch.meaning.c_str());
        y += line;
    }
}

/// Text in the lower left corner.
void drawCaption(const PictureArea& area, const std::string& text, float scale) {
    const float pad = 8.0f * scale;
    const ImVec2 words = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(area.corner.x + pad, area.corner.y + area.size.y - 2.0f * pad - words.y);
    if (text.empty() || area.size.x < words.x + 4.0f * pad) return; // too small to read
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(corner, {corner.x + words.x + 2.0f * pad, corner.y + words.y + pad}, kBehind,
                       ImGui::GetStyle().FrameRounding);
    list.AddText({corner.x + pad, corner.y + 0.5f * pad}, kInk, text.c_str());
}

/// Caption of views that show the shadow of one light.
std::string shownLightText(const engine::DrawnShadows& shadows, const std::vector<scenes::Light>& lights) {
    const std::size_t index = std::size_t(shadows.lights[*shadows.shown].sceneIndex);
    if (index >= lights.size()) return ""; // deleted since
    return "Shadow of " + lightLabel(lights, index) + " (L: of the selected light)";
}

} // namespace

void drawLegend(const State& state, const Facts& facts, const PictureArea& area, float scale) {
    if (state.compare == Compare::Difference) return;
    for (int side = 0; side < state.sides(); ++side) {
        const std::optional<Look>& look = facts.shown[std::size_t(side)];
        if (!look) continue;
        const PictureArea part = partOf(state, area, side);
        if (showsCounts(*look)) {
            const frame::DebugView view = look->settings.view;
            drawBar(part, view, facts.mostCountOf(side, view), countColorsLog2(state, facts, side, view), scale);
        }
        const std::optional<engine::DrawnShadows>& shadows = facts.shadows[std::size_t(side)];
        if (!shadows) continue;
        const std::vector<validation::Swatch> swatches = validation::shadowSwatches(look->settings.view, *shadows);
        if (!swatches.empty()) drawSwatches(part, swatches, scale);
        if (frame::showsShadowsOfOne(look->settings.view) && shadows->shown && state.open)
            drawCaption(part, shownLightText(*shadows, state.open->scene().lights), scale);
    }
}

} // namespace tessera::viewer
