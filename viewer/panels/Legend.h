#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// The scale of a picture of counts (lights or surfaces a pixel), at the picture's lower right.
void drawLegend(const State& state, const PictureArea& area, float scale);

} // namespace tessera::viewer
