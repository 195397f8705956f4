#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Shows over the picture the selected light's outline and its handles; the pointer's shape says what a press does.
void drawHandles(const State& state, const PictureArea& area);

/// Beside the pointer, what a drag sets.
void drawDragText(const State& state, const PictureArea& area);

} // namespace tessera::viewer
