#include "viewer/panels/Overlays.h"

#include <array>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/session/DrawnLook.h"

namespace tessera::viewer {
namespace {

constexpr ImU32 kPlain = IM_COL32(220, 222, 228, 255);
constexpr ImU32 kActive = IM_COL32(140, 195, 255, 255); ///< the side that panels and keys change
enum class Corner { UpperLeft, UpperRight };

/// Words in a corner of a part of the picture, beyond which they do not reach.
void drawName(const std::string& name, const PictureArea& part, Corner corner, ImU32 color, float scale) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::vec2 end = part.corner + part.size;
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 5.0f * scale;
    const float x = corner == Corner::UpperLeft ? part.corner.x + 2.0f * pad : end.x - size.x - 2.0f * pad;
    const float y = part.corner.y + 2.0f * pad;
    list.PushClipRect({part.corner.x, part.corner.y}, {end.x, end.y});
    list.AddRectFilled({x - pad, y - pad}, {x + size.x + pad, y + size.y + pad}, IM_COL32(20, 21, 24, 200), pad);
    list.AddText({x, y}, color, name.c_str());
    list.PopClipRect();
}

bool areEqual(const Facts& facts) {
    return facts.figures && !facts.figuresAreOld && facts.figures->bitEqual == 1.0;
}

} // namespace

void drawDivider(const State& state, const PictureArea& area, float scale) {
    if (state.compare != Compare::Split) return;
    const float x = area.corner.x + state.divider * area.size.x;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine({x, area.corner.y}, {x, area.corner.y + area.size.y}, IM_COL32(235, 240, 250, 200), 1.5f * scale);
    list.AddCircleFilled({x, area.corner.y + 0.5f * area.size.y}, 6.0f * scale, IM_COL32(235, 240, 250, 230));
    const ImGuiIO& io = ImGui::GetIO();
    const bool isFree = !io.WantCaptureMouse && !ImGui::IsAnyMouseDown();
    if (state.isDividerHeld || (isFree && isAtDivider(state, area, {io.MousePos.x, io.MousePos.y})))
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void drawNames(const State& state, const Facts& facts, const PictureArea& area, float scale) {
    if (state.compare == Compare::Difference && areEqual(facts))
        drawName(fmt::format("No difference: all {} covered pixels are equal in every bit", facts.figures->covered),
                 area, Corner::UpperLeft, kPlain, scale);
    if (state.compare != Compare::Split) return;
    const auto& [left, right] = facts.shown;
    if (!left) return;
    const std::vector<scenes::Light>* const lights = state.open ? &state.open->scene().lights : nullptr;
    const std::array<std::string, 2> names =
        right ? sideNames(*left, *right, lights) : std::array{lookName(*left, lights), std::string()};
    for (int side = 0; side < (right ? 2 : 1); ++side)
        drawName(names[std::size_t(side)], partOf(state, area, side),
                 side == 0 ? Corner::UpperLeft : Corner::UpperRight, side == state.activeSide ? kActive : kPlain,
                 scale);
}

} // namespace tessera::viewer
