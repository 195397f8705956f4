#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Draws the markers of lights over the image: lightMarkers().
void drawMarkers(const State& state, const PictureArea& area, float scale);

} // namespace tessera::viewer
