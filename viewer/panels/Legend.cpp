#include "viewer/panels/Legend.h"

#include <algorithm>
#include <string>

#include <imgui.h>

#include "renderer/frame/DebugViews.h"
#include "shaders/shared/heat.h"

namespace tessera::viewer {
namespace {

bool showsCounts(const Look& look) {
    return frame::displayMapping(look.settings.view, look.settings.layout) == frame::DisplayMapping::Count;
}

ImU32 colorAt(float position) {
    const glm::vec3 code = 255.0f * shared::heatColor(position) + 0.5f;
    return IM_COL32(int(code.r), int(code.g), int(code.b), 255);
}

void drawBar(const PictureArea& area, float log2Most, float scale) {
    constexpr int kSteps = 48;
    const float pad = 8.0f * scale, line = ImGui::GetFontSize(), barWidth = 14.0f * scale;
    const float height = std::min(14.0f * line, area.size.y - 4.0f * pad - line);
    const float labelWidth = ImGui::CalcTextSize("000").x;
    if (height < 8.0f * line || area.size.x < 6.0f * labelWidth) return; // no room to read it
    const ImVec2 end(area.corner.x + area.size.x - 2.0f * pad, area.corner.y + area.size.y - 2.0f * pad);
    const float barX = end.x - barWidth, top = end.y - height;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({barX - labelWidth - 2.0f * pad, top - pad - 0.5f * line}, {end.x + pad, end.y + pad},
                       IM_COL32(20, 21, 24, 215), pad);
    const auto yAt = [&](float position) { return end.y - position * height; };
    for (int step = 0; step < kSteps; ++step) {
        const float from = float(step) / kSteps, to = float(step + 1) / kSteps;
        list.AddRectFilled({barX, yAt(to)}, {end.x, yAt(from)}, colorAt(0.5f * (from + to)));
    }
    const auto label = [&](float count) {
        const std::string text = std::to_string(int(count));
        const float y = yAt(std::min(shared::heatPositionOfCount(count, log2Most), 1.0f));
        const float x = barX - 0.75f * pad - ImGui::CalcTextSize(text.c_str()).x;
        list.AddText({x, y - 0.5f * line}, IM_COL32(220, 222, 228, 255), text.c_str());
        list.AddLine({barX - 0.5f * pad, y}, {barX, y}, IM_COL32(220, 222, 228, 255));
    };
    label(0.0f);
    for (float count = 1.0f; shared::heatPositionOfCount(count, log2Most) < 1.0f; count *= 2.0f) label(count);
}

} // namespace

void drawLegend(const State& state, const Facts& facts, const PictureArea& area, float scale) {
    if (state.compare == Compare::Difference) return;
    for (int side = 0; side < state.sides(); ++side) {
        const std::optional<Look>& look = facts.shown[std::size_t(side)];
        if (look && showsCounts(*look))
            drawBar(partOf(state, area, side), float(frame::countScaleLog2(look->settings.view)), scale);
    }
}

} // namespace tessera::viewer
