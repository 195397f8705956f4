#include "viewer/session/SceneEdits.h"

#include <algorithm>
#include <cmath>
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

/// Selection, solo and what is known of types go with their lights after `put` lights came in the place of `taken` from
/// `first` on.
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

void append(State& state, const char* verb, scenes::Light light) {
    const std::size_t count = state.open->scene().lights.size();
    std::string what = fmt::format("{} light '{}'", verb, light.name);
    replace(state, std::move(what), count, 0, {std::move(light)});
    state.selectedLight = int(count);
}

bool isFull(const State& state) {
    return state.open->scene().lights.size() >= std::size_t(scenes::kMostLights);
}

/// What was exchanged is where the user looks.
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
    if (!state.open || isFull(state)) return;
    const scenes::Scene& scene = state.open->scene();
    const double luminance = noticedLuminance(meanLuminance, double(state.active().settings.exposureEV));
    append(state, "add", newLight(scene.lights, lightBefore(scene, state.open->rig().pose(), luminance)));
}

void duplicateSelectedLight(State& state) {
    if (!hasSelected(state) || isFull(state)) return;
    append(state, "duplicate", copyOfLight(state.open->scene().lights, std::size_t(state.selectedLight)));
}

void deleteSelectedLights(State& state) {
    if (!hasSelected(state)) return;
    std::vector<std::size_t> deleted;
    const Lights& lights = state.open->scene().lights;
    for (const int light : state.allSelectedLights())
        if (std::size_t(light) < lights.size()) deleted.push_back(std::size_t(light));
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
    const int left = int(lights.size());
    const int next = int(deleted.back() + 1 - deleted.size());
    state.selectedLights.clear();
    state.selectedLight = left == 0 || state.isDragging ? scenes::kNone : std::min(next, left - 1);
}

void selectLight(State& state, int index, Choosing choosing) {
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
        for (int light = std::min(from, index); light <= std::max(from, index); ++light) selected.insert(light);
        state.selectedLight = index;
        break;
    }
    }
    state.selectedLights = state.selectedLight == scenes::kNone ? std::set<int>() : selected;
}

void selectAllLights(State& state) {
    if (!state.open || state.open->scene().lights.empty()) return;
    const int last = int(state.open->scene().lights.size()) - 1;
    if (!hasSelected(state)) state.selectedLight = last;
    state.selectedLights.clear();
    for (int light = 0; light <= last; ++light) state.selectedLights.insert(state.selectedLights.end(), light);
}

void replaceByScattered(State& state) {
    if (!state.open) return;
    const scenes::Scene& scene = state.open->scene();
    Scatter wanted = state.scatter;
    wanted.lux /= std::exp2(double(state.active().settings.exposureEV)); // as bright in the picture, whatever that is
    Lights scattered = scatterLights(scene, wanted);
    ++state.scatter.seed;
    const std::string what = fmt::format("scatter {} light{}", scattered.size(), scattered.size() == 1 ? "" : "s");
    replace(state, what, 0, scene.lights.size(), std::move(scattered));
    // None of them is one that was there, also where there are as many.
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
