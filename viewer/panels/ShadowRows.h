#pragma once
#include "engine/Renderer.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Rows about the shadows of the latest frame: the atlas, its maps, and a table of lights. A click on a light selects
/// it. Requires an open scene.
void shadowRows(State& state, const engine::DrawnShadows& shadows);

} // namespace tessera::viewer
