#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit/LightList.h"
#include "viewer/edit/Scatter.h"
#include "viewer/panels/ChooseNamed.h"
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
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5f * (ImGui::GetFrameHeight() - side));
    ImGui::ColorButton("##color", color, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
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
    bool changed = chooseNamed("Type", light.type);
    changed |= brightnessRows(light);
    if (light.type != scenes::LightType::Directional) changed |= rangeRows(light);
    if (light.type == scenes::LightType::Spot) changed |= coneRows(light);
    changed |= placeRows(light, sceneSizeMetres);
    return changed;
}

/// Buttons that change which lights there are; whether they did.
bool listButtons(State& state, scenes::Scene& scene) {
    std::optional<int>& solo = state.active().settings.soloLight;
    const bool any = state.selectedLight != scenes::kNone;
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
    bool changed = false;
    if (ImGui::Button("Add", {width, 0.0f}) && scene.lights.size() < std::size_t(scenes::kMostLights)) {
        state.selectedLight = int(addLight(scene.lights, lightAtFocus(state.open->rig().pose())));
        changed = true;
    }
    tip("A point light where the camera's pivot is");
    ImGui::SameLine();
    if (ImGui::Button("Duplicate", {width, 0.0f}) && any && scene.lights.size() < std::size_t(scenes::kMostLights)) {
        state.selectedLight = int(duplicateLight(scene.lights, std::size_t(state.selectedLight)));
        changed = true;
    }
    ImGui::SameLine();
    if (ImGui::Button("Delete", {width, 0.0f}) && any) {
        deleteLight(scene.lights, std::size_t(state.selectedLight), solo);
        state.selectedLight = scenes::kNone;
        changed = true;
    }
    return changed;
}

/// Replaces the lights by many; whether it did.
bool scatterRows(State& state, scenes::Scene& scene) {
    row("Scatter");
    ImGui::SliderInt("##Scatter", &state.scatter.count, 1, kMostScattered, "%d lights",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    row("");
    if (!ImGui::Button("Replace all by these")) return false;
    scene.lights = scatterLights(scene, state.scatter);
    ++state.scatter.seed; // the next ones lie elsewhere
    state.selectedLight = scenes::kNone;
    state.active().settings.soloLight.reset();
    return true;
}

bool animationRows(State& state, scenes::Light& light, double sceneSizeMetres) {
    if (light.type == scenes::LightType::Directional) return false;
    row("Moves");
    bool moves = light.animation.has_value();
    if (!ImGui::Checkbox("by itself", &moves)) return false;
    constexpr double kPeriodSeconds = 6.0;
    if (moves) {
        orbitLight(light, 0.05 * sceneSizeMetres, kPeriodSeconds);
    } else {
        stopLight(light, state.active().settings.timeSeconds);
    }
    return true;
}

} // namespace

void lightsPanel(State& state) {
    if (!state.open) return;
    OpenScene& open = *state.open;
    scenes::Scene& scene = open.edit();
    bool changed = lightList(state, scene);
    changed |= listButtons(state, scene);
    if (state.selectedLight >= int(scene.lights.size())) state.selectedLight = scenes::kNone;
    if (state.selectedLight != scenes::kNone) {
        const scenes::Box3& bounds = open.boundsWS();
        const double size = bounds.empty() ? 1.0 : glm::length(bounds.max - bounds.min);
        scenes::Light& light = scene.lights[std::size_t(state.selectedLight)];
        changed |= lightRows(light, size);
        changed |= animationRows(state, light, size);
    }
    ImGui::Separator();
    changed |= scatterRows(state, scene);
    row("Markers");
    ImGui::Checkbox("show (M)", &state.showsMarkers);
    tip("Drag a marker to move its light");
    row("Animation");
    ImGui::Checkbox("plays (Space)", &state.isPlaying);
    row("Time");
    double& time = state.active().settings.timeSeconds;
    ImGui::DragScalar("##Time", ImGuiDataType_Double, &time, 0.02f, nullptr, nullptr, "%.2f s");
    if (changed) open.touch();
}

} // namespace tessera::viewer
