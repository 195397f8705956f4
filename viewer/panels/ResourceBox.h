#pragma once
#include "viewer/panels/Overlays.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Draws a window with the resource State::resource: a texture or an image of the scene as an image, a buffer as
/// numbers. Draws nothing without one.
void drawResource(State& state, const Facts& facts, const PictureArea& area);

} // namespace tessera::viewer
