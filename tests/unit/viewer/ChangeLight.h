#pragma once
#include <utility>

#include "viewer/session/State.h"

namespace tessera::viewer::test {

/// Changes a light of the open scene, as an edit.
template <typename Change>
void changeLight(State& state, std::size_t index, const Change& change) {
    scenes::Light light = state.open->scene().lights.at(index);
    change(light);
    state.open->changeLight(index, std::move(light));
}

} // namespace tessera::viewer::test
