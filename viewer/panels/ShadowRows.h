#pragma once
#include "engine/Renderer.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// What holds the shadows of the latest frame: the atlas, its maps, and a table of lights. A click on a light selects
/// it. The scene is open.
void shadowRows(State& state, const engine::DrawnShadows& shadows);

} // namespace tessera::viewer
