#include "viewer/panels/Overlays.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/session/DrawnLook.h"
#include "viewer/window/Fonts.h"

namespace tessera::viewer {
namespace {

constexpr ImU32 kPlain = IM_COL32(220, 222, 228, 255);
constexpr ImU32 kActive = IM_COL32(140, 195, 255, 255); ///< the side that panels and keys change
enum class Corner { UpperLeft, UpperRight };

constexpr ImU32 kBehindName = IM_COL32(20, 21, 24, 200);

/// Draws text in a corner of a part of the image, clipped to it. `top` is the height already used in the part, and
/// grows by that of the text.
void drawName(const std::string& name, const PictureArea& part, Corner corner, ImU32 color, float scale, float& top) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::vec2 end = part.corner + part.size;
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 5.0f * scale;
    const float x = corner == Corner::UpperLeft ? part.corner.x + 2.0f * pad : end.x - size.x - 2.0f * pad;
    const float y = part.corner.y + top + 2.0f * pad;
    list.PushClipRect({part.corner.x, part.corner.y}, {end.x, end.y});
    list.AddRectFilled({x - pad, y - pad}, {x + size.x + pad, y + size.y + pad}, kBehindName,
                       ImGui::GetStyle().FrameRounding);
    list.AddText({x, y}, color, name.c_str());
    list.PopClipRect();
    top += size.y + 2.5f * pad;
}

/// The name of a view other than the lit image, large, and its meaning; omitted if they would cover much of the part.
void drawTitle(const Look& look, const std::vector<scenes::Light>* lights, const PictureArea& part, Corner corner,
               float scale, float& top) {
    if (look.settings.view == frame::DebugView::Final) return;
    constexpr float kLeastEms = 16.0f, kMostShare = 0.25f;
    ImFont* const font = ImGui::GetFont();
    ImFont* const titleFont = ImGui::GetIO().Fonts->Fonts.back(); // the title font, if fonts are installed
    const float em = ImGui::GetFontSize(), pad = 5.0f * scale, width = part.size.x - 6.0f * pad;
    const std::string name = viewName(look, lights),
                      meaning = viewMeaning(look.settings.view, look.settings.soloLight.has_value());
    const ImVec2 nameSize = titleFont->CalcTextSizeA(titlePixels(em), FLT_MAX, width, name.c_str());
    const ImVec2 meaningSize = font->CalcTextSizeA(em, FLT_MAX, width, meaning.c_str());
    const ImVec2 size(std::max(nameSize.x, meaningSize.x), nameSize.y + meaningSize.y);
    if (width < kLeastEms * em || top + size.y > kMostShare * part.size.y) return;
    const float x =
        corner == Corner::UpperLeft ? part.corner.x + 2.0f * pad : part.corner.x + part.size.x - size.x - 2.0f * pad;
    const float y = part.corner.y + top + 2.0f * pad;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({x - pad, y - pad}, {x + size.x + pad, y + size.y + pad}, kBehindName,
                       ImGui::GetStyle().FrameRounding);
    list.AddText(titleFont, titlePixels(em), {x, y}, kPlain, name.c_str(), nullptr, width);
    list.AddText(font, em, {x, y + nameSize.y}, kPlain, meaning.c_str(), nullptr, width);
    top += size.y + 2.5f * pad;
}

bool areEqual(const Facts& facts) {
    return facts.figures && !facts.figuresAreOld && facts.figures->bitEqual == 1.0;
}

void drawDifferenceNames(const State& state, const Facts& facts, const std::vector<scenes::Light>* lights,
                         const PictureArea& area, float scale) {
    const auto& [left, right] = facts.shown;
    float top = 0.0f;
    if (left && right) {
        const std::array<std::string, 2> names = sideNames(*left, *right, lights);
        const bool isThere = left->settings.sizePixels == right->settings.sizePixels;
        drawName(isThere ? fmt::format("{} against {}, {:.4g} times; panels set {} (Z)", names[0], names[1],
                                       state.amplification, state.activeSide == 0 ? "the former" : "the latter")
                         : fmt::format("{}; the difference to {} follows", names[0], names[1]),
                 area, Corner::UpperLeft, kPlain, scale, top);
    }
    if (areEqual(facts))
        drawName(fmt::format("No difference: all {} covered pixels are equal in every bit", facts.figures->covered),
                 area, Corner::UpperLeft, kPlain, scale, top);
    if (left && right && left->settings.view == right->settings.view)
        drawTitle(*left, lights, area, Corner::UpperLeft, scale, top);
}

} // namespace

void drawDivider(const State& state, const PictureArea& area, float scale) {
    if (state.compare != Compare::Split) return;
    const float x = area.corner.x + state.divider * area.size.x;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto line = [&](float fromY, float toY) {
        if (fromY < toY) list.AddLine({x, fromY}, {x, toY}, IM_COL32(235, 240, 250, 200), 1.5f * scale);
    };
    // Not through magnified pixels, where it would look like one of the image's edges.
    const std::optional<Box>& box = state.inspectorBox;
    const bool isCut = box && x >= box->corner.x && x <= box->corner.x + box->size.x;
    const float endY = area.corner.y + area.size.y;
    line(area.corner.y, isCut ? box->corner.y : endY);
    if (isCut) line(box->corner.y + box->size.y, endY);
    const float middleY = area.corner.y + 0.5f * area.size.y;
    if (!isCut || middleY < box->corner.y || middleY > box->corner.y + box->size.y)
        list.AddCircleFilled({x, middleY}, 6.0f * scale, IM_COL32(235, 240, 250, 230));
    const ImGuiIO& io = ImGui::GetIO();
    const bool isFree = !io.WantCaptureMouse && !ImGui::IsAnyMouseDown();
    if (state.isDividerHeld || (isFree && isAtDivider(state, area, {io.MousePos.x, io.MousePos.y})))
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void drawNames(const State& state, const Facts& facts, const PictureArea& area, float scale) {
    const auto& [left, right] = facts.shown;
    const std::vector<scenes::Light>* const lights = state.open ? &state.open->scene().lights : nullptr;
    if (state.compare == Compare::Difference) return drawDifferenceNames(state, facts, lights, area, scale);
    if (!left) return;
    const std::array<std::string, 2> names =
        right ? sideNames(*left, *right, lights) : std::array{lookName(*left, lights), std::string()};
    for (int side = 0; side < (right ? state.sides() : 1); ++side) {
        const PictureArea part = partOf(state, area, side);
        const Corner corner = side == 0 ? Corner::UpperLeft : Corner::UpperRight;
        float top = 0.0f;
        if (state.compare == Compare::Split)
            drawName(names[std::size_t(side)], part, corner, side == state.activeSide ? kActive : kPlain, scale, top);
        drawTitle(*facts.shown[std::size_t(side)], lights, part, corner, scale, top);
    }
}

} // namespace tessera::viewer
