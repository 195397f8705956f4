#include "viewer/panels/ShadowRows.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "renderer/frame/ShadowMaps.h"
#include "scenes/Shadows.h"
#include "viewer/edit/LightList.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

constexpr std::size_t kMostLightRows = 8;

/// The side of a light's maps as text.
std::string sideText(const engine::DrawnShadows::Light& light) {
    if (light.sideTexels == 0) return "no room";
    if (light.sideTexels == light.wantedTexels) return std::to_string(light.sideTexels);
    return fmt::format("{} of {}", light.sideTexels, light.wantedTexels);
}

void tableRow(State& state, const engine::DrawnShadows& shadows, std::size_t row) {
    const engine::DrawnShadows::Light& light = shadows.lights[row];
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    if (std::size_t(light.sceneIndex) >= lights.size()) return; // deleted since
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(int(row)); // names may be equal
    const std::string name = labelOf(lightLabel(lights, std::size_t(light.sceneIndex)));
    if (ImGui::Selectable(name.c_str(), light.sceneIndex == state.selectedLight, ImGuiSelectableFlags_SpanAllColumns))
        state.selectedLight = light.sceneIndex;
    if (shadows.hasMaps && light.sideTexels < light.wantedTexels)
        tip(light.sideTexels == 0 ? "The budget has no room for its maps: it casts no shadows"
                                  : "The budget leaves its maps fewer texels than wanted");
    ImGui::PopID();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(shadows.hasMaps ? std::to_string(light.faces).c_str() : "traced");
    if (!shadows.hasMaps) return;
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(sideText(light).c_str());
}

void lightTable(State& state, const engine::DrawnShadows& shadows) {
    const float rowHeight = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
    const float height = float(std::min(shadows.lights.size(), kMostLightRows) + 1) * rowHeight;
    const ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    if (!ImGui::BeginTable("shadowed lights", shadows.hasMaps ? 3 : 2, flags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("light", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn(shadows.hasMaps ? "maps" : "shadows", ImGuiTableColumnFlags_WidthFixed);
    if (shadows.hasMaps) ImGui::TableSetupColumn("side, texels", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(int(shadows.lights.size()));
    while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
            tableRow(state, shadows, std::size_t(row));
    ImGui::EndTable();
}

/// Whether the filter uses light sizes, but none of the lights has one.
bool lacksLightSizes(State& state, const engine::DrawnShadows& shadows) {
    const frame::ShadowFilterInfo& filter = infoOf(state.active().settings.shadowFilter);
    const std::vector<scenes::Light>& lights = state.open->scene().lights;
    return filter.usesMaps && filter.usesSizes &&
           std::ranges::none_of(shadows.lights, [&](const engine::DrawnShadows::Light& light) {
               return std::size_t(light.sceneIndex) < lights.size() &&
                      scenes::hasSize(lights[std::size_t(light.sceneIndex)]);
           });
}

} // namespace

void shadowRows(State& state, const engine::DrawnShadows& shadows) {
    ImGui::Separator();
    if (shadows.lights.empty()) return paragraph("No light in view casts shadows, or nothing hides one.");
    if (shadows.hasMaps) {
        const double texels = double(shadows.atlasTexels.x) * double(shadows.atlasTexels.y);
        fact("Atlas", fmt::format("{}x{} texels", shadows.atlasTexels.x, shadows.atlasTexels.y));
        fact("Memory", fmt::format("{:.4g} of {:g} MiB", texels * double(frame::kShadowTexelBytes) / 1048576.0,
                                   shadows.budgetMiB));
        tip("Of the budget");
        fact("Maps", fmt::format("{}: {} drawn, {} kept", shadows.faces, shadows.drawnFaces,
                                 shadows.faces - shadows.drawnFaces));
        tip("In the latest frame; what has not changed is kept");
    }
    if (lacksLightSizes(state, shadows))
        paragraph(fmt::format("None of these lights has a size, so that {} looks up one texel, as {} does.",
                              infoOf(state.active().settings.shadowFilter).name,
                              infoOf(frame::ShadowFilter::Hard).name));
    lightTable(state, shadows);
}

} // namespace tessera::viewer
