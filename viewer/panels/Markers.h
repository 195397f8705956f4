#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Shows over the picture where lights are: all of them where the state says so, and the selected one.
void drawMarkers(const State& state, const PictureArea& area, float scale);

} // namespace tessera::viewer
