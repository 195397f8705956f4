#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Draws the selected light's outline and handles over the image. The pointer's shape shows what a press does; arms
/// also have a text beside it.
void drawHandles(const State& state, const PictureArea& area);

/// Draws the outline of the selected material, if it is known and a panel shows the material.
void drawMaterialOutline(const State& state, const Facts& facts, const PictureArea& area);

/// Draws the value that a drag sets, beside the pointer.
void drawDragText(const State& state, const PictureArea& area);

} // namespace tessera::viewer
