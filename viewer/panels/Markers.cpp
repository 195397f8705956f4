#include "viewer/panels/Markers.h"

#include <algorithm>

#include <imgui.h>

#include "viewer/edit/ShownColor.h"

namespace tessera::viewer {
namespace {

ImU32 colorOf(const scenes::Light& light) {
    const glm::vec3 code = swatchOfColor(light.color);
    return ImGui::ColorConvertFloat4ToU32({code.r, code.g, code.b, light.enabled ? 1.0f : 0.35f});
}

} // namespace

void drawMarkers(const State& state, const PictureArea& area, float scale) {
    if (!state.open || area.size.x < 1.0f || area.size.y < 1.0f) return;
    const scenes::Scene& scene = state.open->scene();
    const PictureView view = viewOf(state, area);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({area.corner.x, area.corner.y}, {area.corner.x + area.size.x, area.corner.y + area.size.y});
    const auto mark = [&](std::size_t index, bool isSelected) {
        const scenes::Light light = scenes::lightAtTime(scene.lights[index], state.looks[0].settings.timeSeconds);
        if (!scenes::infoOf(light.type).hasPosition()) return;
        const auto place = view.placeOf(light.positionWS);
        if (!place) return;
        const glm::vec2 point = area.corner + glm::vec2(*place);
        list.AddCircleFilled({point.x, point.y}, 3.5f * scale, IM_COL32(20, 20, 24, 200));
        list.AddCircleFilled({point.x, point.y}, 2.5f * scale, colorOf(light));
        if (isSelected) list.AddCircle({point.x, point.y}, 9.0f * scale, IM_COL32(140, 195, 255, 255), 0, 2.0f * scale);
    };
    if (state.showsMarkers)
        for (std::size_t i = 0; i < std::min(scene.lights.size(), kMostMarkers); ++i) mark(i, false);
    if (state.selectedLight != scenes::kNone && state.selectedLight < int(scene.lights.size()))
        mark(std::size_t(state.selectedLight), true);
    list.PopClipRect();
}

} // namespace tessera::viewer
