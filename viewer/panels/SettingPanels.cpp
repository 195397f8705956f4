// Panels of settings: one widget per setting, by its kind, in the order of the table.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "scenes/InUse.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/ShadowRows.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/MapChoices.h"
#include "viewer/session/Preferences.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

using engine::Setting;

/// A list to choose from; it begins with "automatic" if the setting may be unset.
bool show(const Setting& setting, const engine::ChoiceKind& kind, Look& look) {
    using Entry = engine::ChoiceKind::Entry;
    std::vector<Entry> entries = kind.entries;
    const std::string open(setting.value.open);
    if (!open.empty()) entries.insert(entries.begin(), {open, open, setting.byItself});
    std::vector<Choice> choices;
    for (const Entry& entry : entries) {
        engine::ViewRequest tried = look;
        setting.read(tried, entry.name);
        choices.push_back({entry.label, entry.meaning, setting.isSupported(tried)});
    }
    const std::string now = setting.text(look);
    const auto chosen = std::size_t(std::ranges::find(entries, now, &Entry::name) - entries.begin());
    const bool showsLabel = kind.ofNumbers && chosen < entries.size();
    const auto picked =
        choose(setting.panelLabel().c_str(), showsLabel ? entries[chosen].label : now, choices, chosen, setting.help);
    if (picked) setting.read(look, entries[*picked].name);
    return picked.has_value();
}

bool show(const Setting& setting, const engine::NumberKind& kind, Look& look) {
    const std::string id = "##" + setting.panelLabel(), text = setting.text(look);
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    const bool hasSlider = kind.sliderLeast < kind.sliderMost;
    const bool isBounded = hasSlider || (std::isfinite(kind.least) && std::isfinite(kind.most));
    row(setting.panelLabel().c_str(), setting.help);
    bool isEdited = false;
    if (kind.isWhole) {
        constexpr double kMostWhole = 1e9;
        const int least = int(std::max(kind.least, -kMostWhole)), most = int(std::min(kind.most, kMostWhole));
        int edited = int(value);
        isEdited = edit(edited, least, most, [&](int& n) {
            return isBounded ? slideNumber(id.c_str(), n, least, most, "%d") : ImGui::DragInt(id.c_str(), &n);
        });
        if (isEdited) value = edited;
    } else {
        const float sliderLeast = hasSlider ? kind.sliderLeast : float(kind.least);
        const float sliderMost = hasSlider ? kind.sliderMost : float(kind.most);
        float edited = float(value);
        isEdited = editShown(edited, float(kind.least), float(kind.most), kind.format, [&](float& n) {
            return isBounded ? slideNumber(id.c_str(), n, sliderLeast, sliderMost, kind.format)
                             : ImGui::DragFloat(id.c_str(), &n, 0.01f, 0.0f, 0.0f, kind.format);
        });
        if (isEdited) value = std::clamp(double(edited), kind.least, kind.most);
    }
    if (isEdited) setting.read(look, fmt::format("{}", value));
    return isEdited;
}

bool show(const Setting& setting, const engine::SwitchKind&, Look& look) {
    bool isOn = setting.text(look) == "on";
    row(setting.panelLabel().c_str(), setting.help);
    const bool isEdited = ImGui::Checkbox(("##" + setting.panelLabel()).c_str(), &isOn);
    if (isEdited) setting.read(look, isOn ? "on" : "off");
    return isEdited;
}

/// Sizes follow the window, and cameras have their own panel.
bool show(const Setting&, const engine::SizeKind&, Look&) {
    return false;
}
bool show(const Setting&, const engine::CameraKind&, Look&) {
    return false;
}

void settingRows(State& state, engine::SettingPanel panel) {
    Look& look = state.active();
    const scenes::Scene* const scene = state.open ? &state.open->scene() : nullptr;
    for (const Setting& setting : engine::settingTable()) {
        if (setting.panel != panel || !setting.isUsedBy(look.technique)) continue;
        const std::string idle = setting.whyIdle(look, scene);
        ImGui::BeginDisabled(!idle.empty());
        const bool isChosen =
            std::visit([&](const auto& kind) { return show(setting, kind, look); }, setting.value.kind);
        if (isChosen && std::ranges::count(scenes::kEnvironmentViewKeys, setting.key) > 0)
            viewEnvironment(state, environmentSeenBy(look), widgetGesture()); // an edit of the scene
        ImGui::EndDisabled();
        tip(idle);
        if (const auto aside = look.aside.find(setting.key); isChosen && aside != look.aside.end())
            look.aside.erase(aside); // replaced by the new choice
    }
    look = possible(look);
}

void scaleRows(State& state) {
    row("Resolution");
    ImGui::Checkbox("automatic", &state.automaticScale);
    tip("Fewer pixels while something moves, all of them at rest");
    if (state.automaticScale) return;
    slider("Picture scale", state.fixedScale, kLeastScale, 1.0f);
}

void smoothingRow(State& state) {
    row("Edges");
    ImGui::Checkbox("smooth at rest", &state.smooths);
    tip("Once the lit picture is whole, 32 pictures that are shifted by parts of a pixel are drawn, and their mean is "
        "shown. Files that are saved, comparisons and inspected pixels are those of the picture itself.");
}

/// Always one line, so that the rows below do not move under the pointer.
void loadingLine(const State& state, const Facts& facts) {
    if (state.loadingEnvironment.empty()) {
        ImGui::TextDisabled("Open ... above, or drop .hdr or .exr");
        return tip("A picture of all directions: choose Open ... in the list (Ctrl+O), or drop the file anywhere onto "
                   "the window");
    }
    const Progress progress = facts.background.value_or(Progress{"Loading", {}, false});
    const std::string cancel = progress.canCancel ? " (Esc)" : "";
    const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(cancel.c_str()).x;
    ImGui::TextUnformatted((progressText(progress, width) + cancel).c_str());
    if (progress.canCancel) tip("Esc leaves the environment as it is");
}

/// The list of environment maps, and the dialog for others.
void environmentList(State& state, const Facts& facts) {
    std::string source;
    if (state.open && state.open->scene().environment) source = state.open->scene().environment->source;
    const std::vector<MapChoice> maps = mapChoices(state);
    const auto now = std::size_t(std::ranges::find(maps, source, &MapChoice::source) - maps.begin());
    std::vector<Choice> choices;
    for (const MapChoice& map : maps) choices.push_back({map.label, map.meaning});
    choices.push_back({"Open ... (Ctrl+O)", "An .hdr or .exr file of your own"});
    ImGui::BeginDisabled(!state.open);
    if (const auto picked = choose("Map", now < maps.size() ? maps[now].label : source, choices, now)) {
        if (*picked < maps.size())
            state.requests.environment = maps[*picked].name;
        else
            state.requests.showOpenDialog = true;
    }
    ImGui::EndDisabled();
    loadingLine(state, facts);
}

} // namespace

void framePanel(State& state) {
    settingRows(state, engine::SettingPanel::Frame);
}

void environmentPanel(State& state, const Facts& facts) {
    environmentList(state, facts);
    settingRows(state, engine::SettingPanel::Environment);
}

void shadowsPanel(State& state, const Facts& facts) {
    settingRows(state, engine::SettingPanel::Shadows);
    const std::optional<engine::DrawnShadows>& shadows = facts.shadows[std::size_t(state.activeSide)];
    if (shadows && state.open) shadowRows(state, *shadows);
}

void skinPanel(State& state) {
    settingRows(state, engine::SettingPanel::Skin);
    if (state.open && !scenes::anyScatters(state.open->scene()))
        paragraph("No material has subsurface scattering. Choose a method for one in the panel Materials.");
}

void viewPanel(State& state) {
    settingRows(state, engine::SettingPanel::View);
    if (showsCounts(state.active())) {
        row("Heat colours");
        ImGui::Checkbox("range to the data", &state.fitsCountColors);
    }
    scaleRows(state);
    smoothingRow(state);
}

} // namespace tessera::viewer
