#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Shows over the picture where lights are: lightMarkers().
void drawMarkers(const State& state, const PictureArea& area, float scale);

} // namespace tessera::viewer
