#include "viewer/session/SceneEdits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "scenes/Limits.h"
#include "viewer/edit/AddedLight.h"
#include "viewer/edit/LightList.h"

namespace tessera::viewer {
namespace {

bool hasSelected(const State& state) {
    return state.open && state.selectedLight >= 0 && state.selectedLight < int(state.open->scene().lights.size());
}

/// The selected lights that exist; at least one does.
std::set<int> selectedIn(const State& state) {
    std::set<int> selected = state.allSelectedLights();
    selected.erase(selected.lower_bound(int(state.open->scene().lights.size())), selected.end());
    return selected;
}

/// Updates selection, solo and the remembered types after `put` lights have replaced `taken` ones from `first` on.
void followLights(State& state, std::size_t first, std::size_t taken, std::size_t put) {
    if (state.selectedLight != scenes::kNone)
        state.selectedLight = indexAfter(state.selectedLight, first, taken, put).value_or(scenes::kNone);
    std::set<int> selected;
    for (const int light : state.selectedLights)
        if (const auto after = indexAfter(light, first, taken, put)) selected.insert(*after);
    state.selectedLights = std::move(selected);
    for (Look& look : state.looks) {
        std::optional<int>& solo = look.settings.soloLight;
        if (solo) solo = indexAfter(*solo, first, taken, put);
    }
    state.types.follow(first, taken, put);
}

void replace(State& state, std::string what, std::size_t first, std::size_t count, Lights others) {
    const std::size_t put = others.size();
    state.open->replaceLights(std::move(what), first, count, std::move(others));
    followLights(state, first, count, put);
}

/// Appends lights within the scene's limit, and selects them. The last one becomes the one that panels edit.
void append(State& state, const char* verb, Lights added) {
    const std::size_t before = state.open->scene().lights.size(), count = added.size();
    if (before + count > std::size_t(scenes::kMostLights)) return;
    std::string what =
        count == 1 ? fmt::format("{} light '{}'", verb, added.front().name) : fmt::format("{} {} lights", verb, count);
    replace(state, std::move(what), before, 0, std::move(added));
    state.selectedLights.clear();
    for (std::size_t i = 0; i < count; ++i) state.selectedLights.insert(int(before + i));
    state.selectedLight = int(before + count) - 1;
}

/// Copies the values that changed in another light, except its position, name and animation.
void copyChanges(scenes::Light& light, std::size_t index, const scenes::Light& before, const scenes::Light& after) {
    const auto isOwn = [](std::string_view name) {
        return name == "name" || name == "animation" || name == "keyframes";
    };
    const int seed = light.flicker ? light.flicker->seed : int(index);
    scenes::visitFields(scenes::kLightFields, [&](const auto& field) {
        const auto member = field.member;
        if (isOwn(field.name) || before.*member == after.*member) return;
        if constexpr (std::is_same_v<decltype(member), glm::dvec3 scenes::Light::*const>) {
            if (member == &scenes::Light::directionWS) turnLight(light, after.*member);
            if (member == &scenes::Light::alongWS) layLight(light, after.*member);
        } else {
            light.*member = after.*member;
        }
    });
    if (light.flicker) light.flicker->seed = seed;
    // For every type: members that this type does not use are checked too.
    for (const scenes::LightTypeInfo& info : scenes::lightTypes())
        for (const scenes::LightParameter& parameter : info.parameters)
            if (parameter.within != nullptr)
                light.*parameter.member = std::min(light.*parameter.member, light.*parameter.within);
}

/// Selects what the edit exchanged, and updates the looks.
void show(State& state, const Edit& edit) {
    if (const auto* lights = std::get_if<LightsEdit>(&edit)) {
        followLights(state, lights->first, lights->others.size(), lights->count);
        if (lights->count == 1) state.selectedLight = int(lights->first);
    } else if (const auto* material = std::get_if<MaterialEdit>(&edit)) {
        state.selectedMaterial = int(material->index);
    } else if (std::holds_alternative<EnvironmentViewEdit>(edit)) {
        state.viewEnvironmentBy(state.open->environmentView());
    } else if (std::holds_alternative<CameraEdit>(edit)) {
        for (Look& look : state.looks) look.settings.camera = state.open->camera();
    }
}

bool mayStep(const State& state) {
    return state.open && !state.isDragging && !state.open->history().isGestureOpen();
}

} // namespace

void addLight(State& state, double meanLuminance) {
    if (!state.open) return;
    const scenes::Scene& scene = state.open->scene();
    const double luminance = noticedLuminance(meanLuminance, double(state.active().settings.exposureEV));
    append(state, "add", {newLight(scene.lights, lightBefore(scene, state.open->rig().pose(), luminance))});
}

void duplicateSelectedLights(State& state) {
    if (!hasSelected(state)) return;
    append(state, "duplicate", copiesOfLights(state.open->scene().lights, selectedIn(state)));
}

void changeSelectedLights(State& state, const scenes::Light& changed, double sceneSizeMetres, Gesture gesture) {
    if (!hasSelected(state)) return;
    const Lights& lights = state.open->scene().lights;
    const double timeSeconds = state.active().settings.timeSeconds;
    const auto selected = std::size_t(state.selectedLight);
    const scenes::Light before = lights[selected];
    const auto placeWS = [&](const scenes::Light& light) { return scenes::lightAtTime(light, timeSeconds).positionWS; };
    std::map<std::size_t, scenes::Light> all{{selected, changed}};
    for (const int other : selectedIn(state)) {
        const auto index = std::size_t(other);
        if (index == selected) continue;
        scenes::Light light = lights[index];
        if (changed.type != before.type)
            state.types.choose(index, light, changed.type, sceneSizeMetres);
        else
            copyChanges(light, index, before, changed);
        if (changed.positionWS != before.positionWS && scenes::infoOf(light.type).hasPosition())
            placeLight(light, timeSeconds, placeWS(light) + changed.positionWS - before.positionWS);
        all.emplace(index, std::move(light));
    }
    state.open->changeLights(all, gesture);
}

void switchLights(State& state, std::span<const int> switched, bool isOn) {
    std::map<std::size_t, scenes::Light> changed;
    for (const int index : switched) {
        scenes::Light light = state.open->scene().lights[std::size_t(index)];
        light.enabled = isOn;
        changed.emplace(std::size_t(index), std::move(light));
    }
    if (!changed.empty()) state.open->changeLights(changed);
}

void beginRenaming(State& state) {
    if (!hasSelected(state)) return;
    state.renamed = {state.selectedLight, lightLabel(state.open->scene().lights, std::size_t(state.selectedLight))};
    state.reveals = Selected::Light;
    state.showsPanel = true;
}

void endRenaming(State& state) {
    const std::optional<RenamedLight> renamed = std::exchange(state.renamed, std::nullopt);
    if (!renamed || !state.open || renamed->light >= int(state.open->scene().lights.size())) return;
    const auto index = std::size_t(renamed->light);
    const Lights& lights = state.open->scene().lights;
    if (renamed->name.empty() || renamed->name == lightLabel(lights, index)) return;
    scenes::Light light = lights[index];
    light.name = freeLightName(lights, renamed->name);
    if (light.name.size() > scenes::kMostNameBytes) return;
    state.open->changeLight(index, std::move(light));
}

void deleteSelectedLights(State& state) {
    if (!hasSelected(state)) return;
    std::vector<std::size_t> deleted;
    const Lights& lights = state.open->scene().lights;
    for (const int light : selectedIn(state)) deleted.push_back(std::size_t(light));
    // The next light as listed is selected, else the one before.
    const std::vector<int> list = lightsIn(listedLights(lights, state.listing));
    const auto isDeleted = [&](int light) { return std::ranges::binary_search(deleted, std::size_t(light)); };
    int next = scenes::kNone;
    if (const auto behind = std::find_if(list.rbegin(), list.rend(), isDeleted).base(); behind != list.end())
        next = *behind;
    else if (const auto kept = std::find_if_not(list.rbegin(), list.rend(), isDeleted); kept != list.rend())
        next = *kept;
    state.open->deleteLights(deleted.size() == 1 ? fmt::format("delete light '{}'", lightLabel(lights, deleted[0]))
                                                 : fmt::format("delete {} lights", deleted.size()),
                             deleted);
    const auto before = [&](std::size_t light) { return std::ranges::lower_bound(deleted, light) - deleted.begin(); };
    for (Look& look : state.looks) {
        std::optional<int>& solo = look.settings.soloLight;
        if (!solo) continue;
        if (std::ranges::binary_search(deleted, std::size_t(*solo)))
            solo.reset();
        else
            *solo -= int(before(std::size_t(*solo)));
    }
    for (auto light = deleted.rbegin(); light != deleted.rend(); ++light) state.types.follow(*light, 1, 0);
    state.selectedLights.clear();
    state.selectedLight =
        next == scenes::kNone || state.isDragging ? scenes::kNone : next - int(before(std::size_t(next)));
}

void selectLight(State& state, int index, Choosing choosing, std::span<const int> list) {
    std::set<int> selected = state.allSelectedLights();
    switch (choosing) {
    case Choosing::Alone:
        state.selectedLight = selected == std::set<int>{index} ? scenes::kNone : index;
        selected = {index};
        break;
    case Choosing::Toggle:
        if (selected.erase(index) == 0) {
            selected.insert(index);
            state.selectedLight = index;
        } else if (state.selectedLight == index) {
            state.selectedLight = selected.empty() ? scenes::kNone : *selected.rbegin();
        }
        break;
    case Choosing::Range: {
        const int from = state.selectedLight == scenes::kNone ? index : state.selectedLight;
        const auto begin = std::ranges::find(list, from), end = std::ranges::find(list, index);
        if (begin != list.end() && end != list.end())
            selected.insert(std::min(begin, end), std::max(begin, end) + 1);
        else
            for (int light = std::min(from, index); light <= std::max(from, index); ++light) selected.insert(light);
        state.selectedLight = index;
        break;
    }
    }
    state.selectedLights = state.selectedLight == scenes::kNone ? std::set<int>() : selected;
}

void selectLights(State& state, std::span<const int> lights, bool isBeside) {
    if (lights.empty()) return;
    std::set<int> selected = isBeside ? state.allSelectedLights() : std::set<int>();
    selected.insert(lights.begin(), lights.end());
    if (!selected.contains(state.selectedLight)) state.selectedLight = lights.front();
    state.selectedLights = std::move(selected);
}

void selectAllLights(State& state) {
    if (!state.open || state.open->scene().lights.empty()) return;
    // Only the lights that a typed search finds.
    const std::vector<int> all = lightsIn(listedLights(state.open->scene().lights, state.listing));
    state.selectedLights = {all.begin(), all.end()};
    if (!state.selectedLights.contains(state.selectedLight))
        state.selectedLight = all.empty() ? scenes::kNone : *state.selectedLights.rbegin();
}

void replaceByScattered(State& state) {
    if (!state.open) return;
    const scenes::Scene& scene = state.open->scene();
    Scatter wanted = state.scatter;
    wanted.lux /= std::exp2(double(state.active().settings.exposureEV)); // the image is equally bright at any exposure
    Lights scattered = scatterLights(scene, wanted);
    ++state.scatter.seed;
    const std::string what = fmt::format("scatter {} light{}", scattered.size(), scattered.size() == 1 ? "" : "s");
    replace(state, what, 0, scene.lights.size(), std::move(scattered));
    // None of the previous lights is left, even if the count is the same.
    state.selectedLight = scenes::kNone;
    for (Look& look : state.looks) look.settings.soloLight.reset();
    state.types.forget();
}

void viewEnvironment(State& state, const scenes::EnvironmentView& view, Gesture gesture) {
    if (!state.open || !state.open->scene().environment) return;
    state.open->changeEnvironmentView(view, gesture);
    state.viewEnvironmentBy(state.open->environmentView());
}

void undo(State& state) {
    if (!mayStep(state)) return;
    if (const Edit* const edit = state.open->undo()) show(state, *edit);
}

void redo(State& state) {
    if (!mayStep(state)) return;
    if (const Edit* const edit = state.open->redo()) show(state, *edit);
}

void revert(State& state) {
    if (!mayStep(state)) return;
    const std::optional<std::ptrdiff_t> steps = state.open->history().stepsToSaved();
    if (!steps) state.requests.open = state.open->source();
    for (std::ptrdiff_t i = steps.value_or(0); i < 0; ++i) undo(state);
    for (std::ptrdiff_t i = steps.value_or(0); i > 0; --i) redo(state);
}

} // namespace tessera::viewer
