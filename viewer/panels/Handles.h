#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Shows over the picture the selected light's outline and its handles; the pointer's shape says what a press does, at
/// arms words beside it, too.
void drawHandles(const State& state, const PictureArea& area);

/// The outline of what has the selected material, where it is known and a panel shows the material.
void drawMaterialOutline(const State& state, const Facts& facts, const PictureArea& area);

/// Beside the pointer, what a drag sets.
void drawDragText(const State& state, const PictureArea& area);

} // namespace tessera::viewer
