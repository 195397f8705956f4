#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

namespace tessera::viewer {

/// Draws the values of the inspected pixel beside it, adds loupes to State::loupes, and sets State::inspectorBox. Draws
/// nothing without an inspected pixel, or without room in the image.
void drawInspector(State& state, const Facts& facts, const PictureArea& area);

/// Draws the pinned pixels in the image, and a window with their values.
void drawPins(State& state, const PictureArea& area);

} // namespace tessera::viewer
