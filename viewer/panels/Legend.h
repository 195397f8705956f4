#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Draws the scale of each image of counts (lights or surfaces per pixel), or the colours of shadow maps, at its lower
/// right: for the left image beside the divider.
void drawLegend(const State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
