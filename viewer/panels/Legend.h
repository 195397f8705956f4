#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"
#include "viewer/session/State.h"

namespace tessera::viewer {

/// Where the heat colours of a side's picture that shows this view end, as a power of two: at the largest count where
/// it is known and they are to fit it, as in the files of `tessera render`, else where that view always can.
float countColorsLog2(const State& state, const Facts& facts, int side, frame::DebugView view);

/// The scale of each picture that shows counts (lights or surfaces a pixel), or the colours of shadow maps, at its
/// lower right: beside the divider where it is the left one.
void drawLegend(const State& state, const Facts& facts, const PictureArea& area, float scale);

} // namespace tessera::viewer
