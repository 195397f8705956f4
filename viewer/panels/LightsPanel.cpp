#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr float kListRows = 7.0f;
constexpr float kLeastRangeMetres = 1e-3f;
constexpr float kFirstRangeMetres = 10.0f; ///< of a light that had none

bool tableRow(State& state, scenes::Scene& scene, int index) {
    scenes::Light& light = scene.lights[std::size_t(index)];
    bool changed = false;
    ImGui::PushID(index);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    changed |= ImGui::Checkbox("##on", &light.enabled);
    tip("on or off");
    ImGui::TableNextColumn();
    const ImVec4 color(std::sqrt(light.color.r), std::sqrt(light.color.g), std::sqrt(light.color.b), 1.0f);
    const float side = ImGui::GetFontSize();
    ImGui::ColorButton("##color", color, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    ImGui::SameLine();
    const std::string name = light.name.empty() ? fmt::format("light {}", index) : light.name;
    if (ImGui::Selectable(name.c_str(), index == state.selectedLight)) state.selectedLight = index;
    ImGui::TableNextColumn();
    std::optional<int>& solo = state.active().settings.soloLight;
    bool isSolo = solo == index;
    if (ImGui::Checkbox("##solo", &isSolo)) solo = isSolo ? std::optional<int>(index) : std::nullopt;
    tip("only this light shines");
    ImGui::PopID();
    return changed;
}

bool lightList(State& state, scenes::Scene& scene) {
    bool changed = false;
    const float height = kListRows * ImGui::GetFrameHeightWithSpacing();
    const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    if (!ImGui::BeginTable("lights", 3, flags, {0.0f, height})) return false;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("on", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("solo", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper; // tens of thousands of rows, of which few are in view
    clipper.Begin(int(scene.lights.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) changed |= tableRow(state, scene, i);
    ImGui::EndTable();
    return changed;
}

bool typeRow(scenes::Light& light) {
    static constexpr Choice kTypes[] = {{"directional", "From far away"}, {"point", ""}, {"spot", "A cone"}};
    const auto now = std::size_t(light.type);
    const auto chosen = choose("Type", kTypes[now].name, kTypes, now);
    if (chosen) light.type = scenes::LightType(*chosen);
    return chosen.has_value();
}

bool brightnessRows(scenes::Light& light) {
    bool changed = false;
    row("Colour");
    changed |= ImGui::ColorEdit3("##Colour", &light.color.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    const char* unit = light.type == scenes::LightType::Directional ? "%.4g lx" : "%.4g cd";
    row("Intensity");
    changed |=
        ImGui::DragFloat("##Intensity", &light.intensity, 0.01f * std::max(light.intensity, 0.01f), 0.0f, 1e9f,
                         light.falloff == scenes::Falloff::Attenuation ? "%.4g" : unit, ImGuiSliderFlags_AlwaysClamp);
    return changed;
}

bool rangeRows(scenes::Light& light) {
    bool changed = false;
    if (light.falloff == scenes::Falloff::Attenuation) {
        row("A, B, C");
        glm::vec3 attenuation = light.attenuation;
        changed =
            ImGui::DragFloat3("##Attenuation", &attenuation.x, 0.01f, 0.0f, 1e6f, "%.4g", ImGuiSliderFlags_AlwaysClamp);
        tip("Divided by A + B d + C d\xc2\xb2");
        // Not all may be 0: the light would be endless at every distance.
        if (changed && attenuation != glm::vec3(0.0f)) light.attenuation = attenuation;
        return changed;
    }
    bool ends = !std::isinf(light.rangeMetres);
    row("Range");
    if (ImGui::Checkbox("##ends", &ends)) {
        light.rangeMetres = ends ? kFirstRangeMetres : scenes::kInfinity;
        changed = true;
    }
    tip("whether the light ends");
    if (!ends) return changed;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    changed |= ImGui::DragFloat("##Range", &light.rangeMetres, 0.01f * light.rangeMetres, kLeastRangeMetres, 1e6f,
                                "%.3g m", ImGuiSliderFlags_AlwaysClamp);
    return changed;
}

bool coneRows(scenes::Light& light) {
    constexpr float kMostConeRadians = 0.5f * std::numbers::pi_v<float>;
    bool changed = false;
    row("Inner cone");
    changed |= ImGui::SliderAngle("##Inner", &light.innerConeRadians, 0.0f, 90.0f, "%.1f deg");
    row("Outer cone");
    changed |= ImGui::SliderAngle("##Outer", &light.outerConeRadians, 0.0f, 90.0f, "%.1f deg");
    light.outerConeRadians = std::clamp(light.outerConeRadians, 0.0f, kMostConeRadians);
    light.innerConeRadians = std::clamp(light.innerConeRadians, 0.0f, light.outerConeRadians);
    return changed;
}

bool dragVector(const char* label, glm::dvec3& value, float speed) {
    row(label);
    return ImGui::DragScalarN((std::string("##") + label).c_str(), ImGuiDataType_Double, &value.x, 3, speed, nullptr,
                              nullptr, "%.3f");
}

bool placeRows(scenes::Light& light, double sceneSizeMetres) {
    bool changed = false;
    if (light.type != scenes::LightType::Directional)
        changed |= dragVector("Position", light.positionWS, float(0.001 * sceneSizeMetres));
    if (light.type != scenes::LightType::Point) {
        glm::dvec3 directionWS = light.directionWS;
        if (dragVector("Direction", directionWS, 0.01f) && glm::length(directionWS) > 1e-3) {
            light.directionWS = glm::normalize(directionWS);
            changed = true;
        }
    }
    return changed;
}

bool lightRows(scenes::Light& light, double sceneSizeMetres) {
    bool changed = typeRow(light);
    changed |= brightnessRows(light);
    if (light.type != scenes::LightType::Directional) changed |= rangeRows(light);
    if (light.type == scenes::LightType::Spot) changed |= coneRows(light);
    changed |= placeRows(light, sceneSizeMetres);
    if (light.animation) ImGui::TextDisabled("Moves by itself; Space plays");
    return changed;
}

} // namespace

void lightsPanel(State& state) {
    if (!state.open) return;
    OpenScene& open = *state.open;
    scenes::Scene& scene = open.edit();
    bool changed = lightList(state, scene);
    if (state.selectedLight >= int(scene.lights.size())) state.selectedLight = scenes::kNone;
    if (state.selectedLight != scenes::kNone) {
        const scenes::Box3& bounds = open.boundsWS();
        const double size = bounds.empty() ? 1.0 : glm::length(bounds.max - bounds.min);
        changed |= lightRows(scene.lights[std::size_t(state.selectedLight)], size);
    }
    row("Animation");
    ImGui::Checkbox("plays (Space)", &state.isPlaying);
    row("Time");
    double& time = state.active().settings.timeSeconds;
    ImGui::DragScalar("##Time", ImGuiDataType_Double, &time, 0.02f, nullptr, nullptr, "%.2f s");
    if (changed) open.touch();
}

} // namespace tessera::viewer
