#include "viewer/panels/ProgressBox.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/Widgets.h"

namespace tessera::viewer {

namespace {

/// The first corner where a box does not overlap another one; `fromEdge` keeps it off the lower and upper edges, which
/// have messages and names.
glm::vec2 freeCorner(const PictureArea& area, const glm::vec2& size, float pad, float fromEdge,
                     const std::optional<Box>& other) {
    const float left = area.corner.x + pad, right = area.corner.x + area.size.x - pad - size.x;
    const float lower = area.corner.y + area.size.y - fromEdge - size.y, upper = area.corner.y + fromEdge;
    const glm::vec2 corners[] = {{left, lower}, {right, lower}, {left, upper}, {right, upper}};
    for (const glm::vec2& corner : corners)
        if (!other || !Box{corner, size}.meets(*other)) return corner;
    return corners[0];
}

} // namespace

void drawProgress(const Progress& progress, const PictureArea& area, const std::optional<Box>& other, float scale,
                  ImDrawList& list) {
    constexpr ImU32 kBox = IM_COL32(20, 21, 24, 255), kWords = IM_COL32(220, 222, 228, 255);
    constexpr ImU32 kRail = IM_COL32(60, 62, 68, 255), kDone = IM_COL32(70, 140, 220, 255);
    constexpr float kWidthEms = 24.0f, kAboveEdgeEms = 5.0f; // above a message of one line
    const float em = ImGui::GetFontSize(), pad = 8.0f * scale, rail = 5.0f * scale;
    const float width = std::min(kWidthEms * em, area.size.x - 2.0f * pad);
    const ImVec2 size(width, 2.0f * em + rail + 4.0f * pad);
    if (width < 8.0f * em || area.size.y < size.y + 2.0f * pad) return; // too small to read
    const float fromEdge = std::min(kAboveEdgeEms * em, area.size.y - size.y - pad);
    const glm::vec2 place = freeCorner(area, {size.x, size.y}, pad, fromEdge, other);
    const ImVec2 corner(place.x, place.y);
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    list.AddRectFilled(corner, end, kBox, pad);
    list.PushClipRect(corner, end, true);
    const float left = corner.x + pad, right = end.x - pad;
    const std::string words = progressText(progress, right - left);
    list.AddText({left, corner.y + pad}, kWords, words.c_str());
    const float railY = corner.y + 2.0f * pad + em;
    if (progress.share) {
        const float done = float(std::clamp(*progress.share, 0.0, 1.0));
        list.AddRectFilled({left, railY}, {right, railY + rail}, kRail);
        list.AddRectFilled({left, railY}, {left + done * (right - left), railY + rail}, kDone);
    }
    if (progress.canCancel) list.AddText({left, railY + rail + pad}, kWords, "Esc cancels");
    list.PopClipRect();
}

std::string progressText(const Progress& progress, float widthPixels) {
    const float mostEnd = ImGui::CalcTextSize(": 100 %").x;
    const std::string end = progress.share ? fmt::format(": {:.0f} %", 100.0 * *progress.share) : " ...";
    return shortened(progress.text, widthPixels - mostEnd) + end;
}

/// In percent of tiles, so that even a single object shows progress.
std::string diffusionText(const engine::DiffusionProgress& progress) {
    const std::size_t percent = progress.tiles > 0 ? 100 * progress.doneTiles / progress.tiles : 0;
    return fmt::format("diffusing light: {} of {} object{}, {} %", progress.doneObjects, progress.objects,
                       progress.objects == 1 ? "" : "s", percent);
}

} // namespace tessera::viewer
