#include "viewer/panels/Markers.h"

#include <cmath>
#include <numbers>

#include <imgui.h>

#include "viewer/edit/ShownColor.h"

namespace tessera::viewer {
namespace {

ImU32 colorOf(const scenes::Light& light) {
    const glm::vec3 code = swatchOfColor(light.color);
    return ImGui::ColorConvertFloat4ToU32({code.r, code.g, code.b, light.enabled ? 1.0f : 0.35f});
}

void drawRays(ImDrawList& list, const glm::vec2& point, ImU32 ink, float scale) {
    constexpr int kRays = 8;
    for (int ray = 0; ray < kRays; ++ray) {
        const float angle = 2.0f * std::numbers::pi_v<float> * float(ray) / kRays;
        const glm::vec2 way(std::cos(angle), std::sin(angle));
        const glm::vec2 from = point + 6.0f * scale * way, to = point + 9.0f * scale * way;
        list.AddLine({from.x, from.y}, {to.x, to.y}, IM_COL32(20, 20, 24, 200), 3.0f * scale);
        list.AddLine({from.x, from.y}, {to.x, to.y}, ink, 1.5f * scale);
    }
}

} // namespace

void drawMarkers(const State& state, const PictureArea& area, float scale) {
    if (!state.open || area.size.x < 1.0f || area.size.y < 1.0f) return;
    const scenes::Scene& scene = state.open->scene();
    constexpr ImU32 kSelectedInk = IM_COL32(140, 195, 255, 255), kRimInk = IM_COL32(20, 20, 24, 200);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({area.corner.x, area.corner.y}, {area.corner.x + area.size.x, area.corner.y + area.size.y});
    for (const LightMarker& marker : lightMarkers(state, area)) {
        const glm::vec2 point = area.corner + glm::vec2(marker.place);
        const ImU32 ink =
            colorOf(scenes::lightAtTime(scene.lights[std::size_t(marker.light)], state.looks[0].settings.timeSeconds));
        const float radius = (marker.isSun ? 4.0f : 2.5f) * scale;
        if (marker.isSun) drawRays(list, point, ink, scale);
        list.AddCircleFilled({point.x, point.y}, radius + scale, kRimInk);
        list.AddCircleFilled({point.x, point.y}, radius, ink);
        if (state.isLightSelected(marker.light))
            list.AddCircle({point.x, point.y}, 9.0f * scale, kSelectedInk, 0, 2.0f * scale);
    }
    list.PopClipRect();
}

} // namespace tessera::viewer
