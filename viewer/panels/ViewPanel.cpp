#include <fmt/format.h>
#include <imgui.h>

#include "passes/recipes/ChooseView.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/Preferences.h"

namespace tessera::viewer {
namespace {

void viewRow(Look& look) {
    const auto table = frame::viewTable();
    std::vector<std::string> names;
    std::vector<Choice> choices;
    std::size_t chosen = 0;
    for (const frame::ViewInfo& info : table)
        names.push_back(info.key > 0 ? fmt::format("{}  ({})", info.name, info.key) : std::string(info.name));
    for (std::size_t i = 0; i < table.size(); ++i) {
        choices.push_back({names[i], table[i].meaning, recipes::takesView(infoOf(look.technique), table[i].view)});
        if (table[i].view == look.settings.view) chosen = i;
    }
    if (const auto now = choose("View", table[chosen].name, choices, chosen)) look.settings.view = table[*now].view;
}

void toneMapRow(frame::FrameSettings& settings) {
    const auto table = frame::toneMapTable();
    const std::size_t now = std::size_t(settings.toneMap);
    if (const auto chosen = choose("Tone map", table[now].name, choicesOf(table), now))
        settings.toneMap = table[*chosen].toneMap;
}

void scaleRows(State& state) {
    row("Resolution");
    ImGui::Checkbox("automatic", &state.automaticScale);
    tip("Fewer pixels while something moves, all of them at rest");
    if (state.automaticScale) return;
    slider("Scale", state.fixedScale, kLeastScale, 1.0f);
}

} // namespace

void viewPanel(State& state) {
    Look& look = state.active();
    viewRow(look);
    row("Exposure");
    edit(look.settings.exposureEV, -kMostExposureEV, kMostExposureEV,
         [](float& exposureEV) { return ImGui::SliderFloat("##Exposure", &exposureEV, -10.0f, 10.0f, "%+.1f EV"); });
    toneMapRow(look.settings);
    scaleRows(state);
}

} // namespace tessera::viewer
