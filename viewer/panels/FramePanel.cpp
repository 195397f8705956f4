#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "passes/recipes/ChooseCulling.h"
#include "passes/recipes/ChooseLighting.h"
#include "passes/recipes/ChooseSamples.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

/// A row of choices in front of which stands "automatic", for options that may be left open. Whether one was chosen.
template <typename Value>
bool chooseOrOpen(const char* label, std::optional<Value>& value, std::vector<Choice> choices,
                  std::span<const Value> values, std::string_view automatic) {
    choices.insert(choices.begin(), {"automatic", automatic});
    std::size_t chosen = 0;
    for (std::size_t i = 0; value && i < values.size(); ++i)
        if (values[i] == *value) chosen = i + 1;
    const auto now = choose(label, choices[chosen].name, choices, chosen);
    if (now && *now == 0) value.reset();
    if (now && *now > 0) value = values[*now - 1];
    return now.has_value();
}

template <typename Table, typename Member>
auto valuesOf(const Table& table, Member member) {
    std::vector<std::remove_cvref_t<decltype((*table.begin()).*member)>> values;
    for (const auto& entry : table) values.push_back(entry.*member);
    return values;
}

void techniqueRow(Look& look) {
    const auto meaning = [](const recipes::TechniqueInfo& info) { return info.lighting; };
    const auto choices = choicesOf(recipes::techniqueTable(), meaning, [](const auto&) { return true; });
    const recipes::TechniqueInfo& now = infoOf(look.technique);
    if (const auto chosen = choose("Technique", now.name, choices, std::size_t(look.technique)))
        look.technique = recipes::techniqueTable()[*chosen].technique;
}

void cullingRows(Look& look) {
    culling::Settings& settings = look.settings.culling;
    const auto takes = [&](const culling::MethodInfo& info) {
        return recipes::takesMethod(look.technique, info.method);
    };
    const auto summary = [](const auto& info) { return info.summary; };
    const auto methods = valuesOf(culling::methodTable(), &culling::MethodInfo::method);
    if (chooseOrOpen<culling::Method>("Culling", settings.method, choicesOf(culling::methodTable(), summary, takes),
                                      methods, "the technique's own"))
        look.aside.method.reset();
    if (!recipes::hasLightLists(look.technique)) return;
    std::vector<std::string> names;
    for (const int side : culling::kTileSides) names.push_back(fmt::format("{} pixels", side));
    const std::vector<Choice> sides(names.begin(), names.end());
    chooseOrOpen<int>("Tile", settings.tilePixels, sides, culling::kTileSides, "16 pixels");
    const auto builders = valuesOf(culling::builderTable(), &culling::BuilderInfo::builder);
    chooseOrOpen<culling::Builder>("Lists on", settings.builder, choicesOf(culling::builderTable()), builders,
                                   "what is fastest on this renderer");
}

void layoutRow(Look& look) {
    const auto table = frame::layoutTable();
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < table.size(); ++i)
        if (table[i].layout == look.settings.layout) chosen = i;
    if (const auto now = choose("G-buffer", table[chosen].name, choicesOf(table), chosen))
        look.settings.layout = table[*now].layout;
}

void samplesRow(Look& look) {
    std::vector<std::string> names;
    std::vector<Choice> choices;
    std::size_t chosen = 0;
    for (const int samples : frame::kSampleCounts) names.push_back(std::to_string(samples));
    for (std::size_t i = 0; i < names.size(); ++i) {
        choices.push_back({names[i], "", recipes::takesSamples(infoOf(look.technique), frame::kSampleCounts[i])});
        if (frame::kSampleCounts[i] == look.settings.samples) chosen = i;
    }
    if (const auto now = choose("Samples", names[chosen], choices, chosen))
        look.settings.samples = frame::kSampleCounts[*now];
}

void switchRows(frame::FrameSettings& settings) {
    const auto flag = [](const char* label, bool& value, const char* meaning) {
        row(label);
        ImGui::Checkbox((std::string("##") + label).c_str(), &value);
        tip(meaning);
    };
    flag("Leave out", settings.prune, "Leaves out what the scene does not need; the picture is the same");
    flag("Specular", settings.specular, "The specular lobe");
}

} // namespace

void framePanel(State& state) {
    Look& look = state.active();
    techniqueRow(look);
    cullingRows(look);
    if (infoOf(look.technique).usesGBuffer()) layoutRow(look);
    if (recipes::infoOf(look.technique).choosesStage) {
        const auto stages = valuesOf(frame::lightingStageTable(), &frame::LightingStageInfo::stage);
        chooseOrOpen<frame::LightingStage>("Light on", look.settings.lightOn, choicesOf(frame::lightingStageTable()),
                                           stages, "fragment shaders");
    }
    if (infoOf(look.technique).multisamples()) samplesRow(look);
    switchRows(look.settings);
    look = possible(look);
}

} // namespace tessera::viewer
