#pragma once
#include "viewer/session/Controls.h"
#include "viewer/session/Facts.h"

namespace tessera::viewer {

/// What the picture shows at the inspected pixel, in words beside it, and where the loupes are to be drawn
/// (added to State::loupes); State::inspectorBox. Nothing where nothing is inspected, or the picture has no room.
void drawInspector(State& state, const Facts& facts, const PictureArea& area);

/// The pixels that are pinned, in the picture, and a window of what was told of them.
void drawPins(State& state, const PictureArea& area);

} // namespace tessera::viewer
