#pragma once
#include "viewer/panels/Overlays.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// A window over the picture with what State::resource names: a texture as a picture, a buffer as numbers. Draws
/// nothing where that names none.
void drawResource(State& state, const Facts& facts, const PictureArea& area);

} // namespace tessera::viewer
