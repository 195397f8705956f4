#include "viewer/session/LightEdits.h"

#include <utility>

#include "viewer/edit/LightList.h"

namespace tessera::viewer {
namespace {

void replaceLights(State& state, Lights lights) {
    state.open->edit().lights = std::move(lights);
    state.selectedLight = scenes::kNone;
    state.active().settings.soloLight.reset();
    state.open->touch();
}

} // namespace

void deleteSelectedLight(State& state) {
    if (!state.open) return;
    Lights& lights = state.open->edit().lights;
    if (state.selectedLight < 0 || state.selectedLight >= int(lights.size())) return;
    deleteLight(lights, std::size_t(state.selectedLight), state.active().settings.soloLight);
    state.selectedLight = scenes::kNone;
    state.open->touch();
}

void replaceByScattered(State& state) {
    if (!state.open) return;
    const scenes::Scene& scene = state.open->scene();
    Lights scattered = scatterLights(scene, state.scatter);
    // What was scattered just before is nobody's work.
    if (!state.replaced || state.replaced->edits != state.open->edits()) state.replaced = Replaced{scene.lights, 0};
    ++state.scatter.seed;
    replaceLights(state, std::move(scattered));
    state.replaced->edits = state.open->edits();
}

void bringBackReplaced(State& state) {
    if (!state.open || !state.replaced) return;
    replaceLights(state, std::move(std::exchange(state.replaced, std::nullopt)->lights));
}

} // namespace tessera::viewer
