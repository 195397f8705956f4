#include "viewer/session/LightEdits.h"

#include "viewer/edit/LightList.h"

namespace tessera::viewer {

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
    scenes::Scene& scene = state.open->edit();
    scene.lights = scatterLights(scene, state.scatter);
    ++state.scatter.seed;
    state.selectedLight = scenes::kNone;
    state.active().settings.soloLight.reset();
    state.open->touch();
}

} // namespace tessera::viewer
