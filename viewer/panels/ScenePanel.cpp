#include <algorithm>
#include <cfloat>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "scenes/Defaults.h"
#include "scenes/Load.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/Widgets.h"
#include "viewer/session/SceneSource.h"

namespace tessera::viewer {
namespace {

std::string shortName(const std::string& source) {
    return std::filesystem::path(source).filename().string();
}

void sceneList(State& state, const Facts& facts) {
    row("Scene");
    const std::string shown = state.open ? shortName(state.open->source()) : "none";
    if (!ImGui::BeginCombo("##Scene", labelOf(shown).c_str(), ImGuiComboFlags_HeightLargest)) return;
    closeOnEscape();
    state.wantsThumbnails = true;
    const glm::vec2 pictureSize = glm::vec2(20.0f, 11.25f) * ImGui::GetFontSize();
    const auto entry = [&](const std::string& source, std::string_view meaning) {
        const bool isOpen = state.open && identityOf(state.open->source()) == identityOf(source);
        ImGui::PushID(source.c_str());
        if (ImGui::Selectable(labelOf(shortName(source)).c_str(), isOpen)) state.requests.open = source;
        const auto found = facts.thumbnails.find(source);
        tip(meaning, found == facts.thumbnails.end() ? SmallPicture{} : SmallPicture{found->second, pictureSize});
        ImGui::PopID();
    };
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes())
        entry(std::string(builtin.name), builtin.purpose);
    if (!state.recent.empty()) ImGui::Separator();
    for (const std::string& file : state.recent) entry(file, file);
    ImGui::EndCombo();
}

/// A slider for each parameter of the scene's hook.
void hookRows(OpenScene& open) {
    if (!open.scene().hook) return;
    const std::vector<scenes::HookParameter>& parameters = open.scene().hook->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        float value = parameters[i].value;
        if (slider(parameters[i].name.c_str(), value, parameters[i].least, parameters[i].most))
            open.changeHookParameter(i, value, widgetGesture());
    }
}

/// Chooses a material variant, for models that have some.
void variantList(State& state) {
    const std::vector<std::string>& variants = state.open->scene().variants;
    if (variants.empty()) return;
    const std::string shown = state.open->load().import.variant.value_or("");
    std::vector<Choice> choices{{"as the file has it", "the materials without a variant, else that of the scene file"}};
    for (const std::string& variant : variants) choices.push_back({variant, "a variant of the materials"});
    const auto now = std::size_t(std::ranges::find(variants, shown) - variants.begin());
    const std::size_t chosen = now < variants.size() ? now + 1 : 0;
    if (const auto picked = choose("Variant", choices[chosen].name, choices, chosen))
        state.requests.variant = *picked == 0 ? std::string() : variants[*picked - 1];
}

} // namespace

void scenePanel(State& state, const Facts& facts) {
    sceneList(state, facts);
    if (ImGui::Button("Open ... (Ctrl+O)", {-FLT_MIN, 0.0f})) state.requests.showOpenDialog = true;
    tip("A scene, a model or an environment of your own");
    if (!state.loading.empty()) {
        const Progress loading{"Loading " + shortName(state.loading), {}, false};
        ImGui::TextUnformatted(progressText(loading, ImGui::GetContentRegionAvail().x).c_str());
    } else {
        ImGui::TextDisabled("or drop a file anywhere onto the window");
    }
    if (!state.open) return;
    variantList(state);
    const scenes::Scene& scene = state.open->scene();
    fact("Triangles", fmt::format("{}", scenes::triangleCount(scene)));
    fact("Lights", fmt::format("{}", scene.lights.size()));
    fact("Materials", fmt::format("{}", scene.materials.size()));
    hookRows(*state.open);
    if (const std::string supplied = scenes::suppliedText(scene, scenes::Advice::Panels); !supplied.empty())
        paragraph(supplied);
    for (const std::string& note : scene.notes) paragraph(note);
    for (const std::string& warning : scene.warnings) paragraph(warning);
}

} // namespace tessera::viewer
