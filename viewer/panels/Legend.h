#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// The scale of each picture that shows counts (lights or surfaces a pixel), or the colours of shadow maps, at its
/// lower right: beside the divider where it is the left one.
void drawLegend(const State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
